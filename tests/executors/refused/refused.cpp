// Compiled once a case by refused.cmake: the first must compile, the others must not.
#include <plexway/executors/gl.hpp>
#include <plexway/solve.hpp>

using namespace plexway;

void call(const TriangleMesh<float>& surface, [[maybe_unused]] const TriangleMesh<double>& precise,
          [[maybe_unused]] const SimplicialComplex<float, 4>& simplices,
          [[maybe_unused]] const MixedComplex<double>& mixed) {
  const PointSource source = PointSource::at(0);
  (void)solve(Serial{}, surface, source, NearestFirst{});
#if defined(PLEXWAY_FITS)
  (void)solve(GL{}, surface, VertexSource{.vertices = {1, 2}});
  (void)solve(OpenMP{}, precise, BallSource{.centre = source, .radius = 1});
  (void)solve(OpenMP{}, mixed, source);
  (void)solve_each(GL{}, surface, source);
#elif defined(PLEXWAY_GL_DOMAIN)
  (void)solve(GL{}, simplices, source);
#elif defined(PLEXWAY_GL_DOUBLE)
  (void)solve(GL{}, precise, source);
#elif defined(PLEXWAY_GL_EACH)
  (void)solve_each(GL{}, precise, source);
#elif defined(PLEXWAY_ORDER)
  (void)solve(OpenMP{}, surface, source, NearestFirst{});
#elif defined(PLEXWAY_GL_ORDER)
  (void)solve(GL{}, surface, source, NearestFirst{});
#endif
}
