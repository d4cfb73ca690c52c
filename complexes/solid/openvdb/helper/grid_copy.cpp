#include "grid_copy.hpp"

#include <openvdb/openvdb.h>

#include <vector>

#include "grid_bricks.hpp"
#include "number_text.hpp"

namespace plexway::openvdb {
namespace {

using ::openvdb::GridBase;

std::string in_quotes(const std::string& name) { return "'" + name + "'"; }

std::string what_it_is(const GridBase& grid) {
  if (grid.getGridClass() == ::openvdb::GRID_FOG_VOLUME) return "a fog volume";
  return "a grid of " + grid.valueType();
}

bool has_fit_values(const GridBase& grid) {
  return grid.isType<::openvdb::FloatGrid>() || grid.isType<::openvdb::DoubleGrid>();
}

// Some programs lose the class. Outside is positive in a level set, and 0 in a fog.
bool may_be_level_set(const GridBase& grid) {
  if (!has_fit_values(grid)) return false;
  if (grid.getGridClass() == ::openvdb::GRID_LEVEL_SET) return true;
  if (grid.getGridClass() != ::openvdb::GRID_UNKNOWN) return false;
  if (const auto* f = dynamic_cast<const ::openvdb::FloatGrid*>(&grid)) return f->background() > 0;
  return dynamic_cast<const ::openvdb::DoubleGrid&>(grid).background() > 0;
}

std::string choose(const std::vector<GridBase::Ptr>& grids, const std::string& wanted) {
  if (grids.empty()) throw InputError("has no grids");
  std::string all, fit;
  std::size_t fits = 0;
  std::string chosen;
  for (const GridBase::Ptr& grid : grids) {
    all += (all.empty() ? "" : ", ") + in_quotes(grid->getName());
    if (!wanted.empty() && grid->getName() == wanted) return wanted;
    // What a fog and a level set share is their type: say what is wrong with it afterwards.
    const bool level_set = grid->getGridClass() == ::openvdb::GRID_LEVEL_SET;
    if (!level_set && grids.size() > 1) continue;
    chosen = grid->getName();
    fit += (fit.empty() ? "" : ", ") + in_quotes(chosen);
    ++fits;
  }
  if (!wanted.empty()) throw InputError("has no grid " + in_quotes(wanted) + "; it has " + all);
  if (fits == 0)
    throw InputError("has several grids, none marked as a level set; choose one of " + all);
  if (fits > 1) throw InputError("has several level sets; choose one of " + fit);
  return chosen;
}

template <class Grid>
void copy(const Grid& grid, const std::function<void(const GridHead&)>& head,
          const BrickTaker& brick) {
  GridHead it;
  it.frame = frame_of(grid.constTransform());
  it.background = static_cast<float>(grid.background());
  if (!(it.background > 0) || !std::isfinite(it.background))
    throw InputError("its background is " + text_of(it.background) +
                     ", which must be above 0 in a level set");
  it.name = grid.getName();
  it.active = grid.activeVoxelCount();
  head(it);
  hand_out(grid.constTree(), brick);
}

}  // namespace

void copy_grid(const std::string& file, const std::string& wanted,
               const std::function<void(const GridHead&)>& head, const BrickTaker& brick) {
  // Never freed: the process ends here, and a damaged file may have bent what there is to free.
  auto& input = *new ::openvdb::io::File(file);
  auto& grid = *new GridBase::Ptr;
  std::string name;
  try {
    ::openvdb::initialize();
    input.setCopyMaxBytes(0);
    input.open(false);
    const auto metadata = input.readAllGridMetadata();
    name = choose(*metadata, wanted);
    for (const GridBase::Ptr& one : *metadata)
      if (one->getName() == name && !has_fit_values(*one))
        throw InputError("grid " + in_quotes(name) + " is " + what_it_is(*one) +
                         ", not a level set of numbers");
    grid = input.readGrid(name);
  } catch (const ::openvdb::Exception& error) {
    throw InputError(std::string("OpenVDB cannot read it: ") + error.what());
  }
  if (!grid) throw InputError("OpenVDB gave no grid");
  if (!may_be_level_set(*grid))
    throw InputError(
        "grid " + in_quotes(name) + " is " + what_it_is(*grid) +
        ", not a level set; give one, negative inside (Houdini's Convert VDB makes it)");
  try {
    if (const auto* single = dynamic_cast<const ::openvdb::FloatGrid*>(grid.get()))
      copy(*single, head, brick);
    else
      copy(dynamic_cast<const ::openvdb::DoubleGrid&>(*grid), head, brick);
  } catch (const InputError& error) {
    throw InputError("grid " + in_quotes(name) + ": " + error.what());
  }
}

}  // namespace plexway::openvdb
