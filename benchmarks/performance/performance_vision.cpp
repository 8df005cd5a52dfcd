// What vision costs; one measurement of scripts/bench at a time.
#include "castor/benchmarks/performance/measurement.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/segmentation/segmentation.hpp"
#include "castor/perception/vision/segmentation/size_limits.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <vector>

namespace castor::benchmark {

namespace {

/// A blue ball and a red cube on wood.
vision::Image picture(const vision::Camera& camera) {
  vision::TabletopSnapshot scene;
  vision::TabletopObject ball;
  ball.shape = vision::TabletopShape::sphere;
  ball.colour = {30, 60, 190};
  ball.x = -0.1;
  ball.size = {0.06, 0.06, 0.06};
  vision::TabletopObject cube;
  cube.shape = vision::TabletopShape::cube;
  cube.colour = {180, 30, 30};
  cube.x = 0.1;
  cube.size = {0.055, 0.055, 0.055};
  scene.objects = {ball, cube};
  return render(scene, camera);
}

/// Time to segment the first picture after what a segmentor does when it is configured, and later
/// ones, milliseconds: figures `first` and `later`, and by how much the first takes longer,
/// `ratio`.
void measure_first_picture(const Arguments& x) {
  const auto camera = geometry::look_at({0, -0.62, 0.55}, {0, 0.03, 0}, 42, 640, 480);
  const auto image = picture(camera);
  vision::prepare_segmentation();
  std::vector<double> times;
  const auto end = std::chrono::steady_clock::now() + x.duration();
  do {
    const auto begin = std::chrono::steady_clock::now();
    if (segment_table(image, &camera).size() != 2)
      throw std::runtime_error{"the ball and the cube are not found"};
    times.push_back(
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  } while (times.size() < 3 || std::chrono::steady_clock::now() < end);
  const auto first = times.front();
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin() + 1, middle, times.end());
  print_figure("first", first);
  print_figure("later", *middle);
  print_figure("ratio", first / *middle);
}

} // namespace

} // namespace castor::benchmark

int main(int argc, char** argv) {
  using namespace castor::benchmark;
  return run_measurement(argc, argv, {{"first_picture", measure_first_picture}});
}
