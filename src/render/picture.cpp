#include <plexway/render/picture.hpp>

#include "composition.hpp"
#include "drawing.hpp"
#include "finish.hpp"

namespace plexway::render {

Image picture(const Scene& scene, const PictureOptions& options) {
  const Composition made = compose(scene, options);
  Drawn drawn = draw(made.batches, options.width, options.height, made.style);
  shade_hollows(drawn, made.style.camera);
  Image image = reduced(drawn);
  ImageSheet sheet(image);
  if (options.legend) draw_legend(sheet, made.legend);
  return image;
}

}  // namespace plexway::render
