#include "castor/benchmarks/clevr/clevr_camera.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <vector>

#include <Eigen/QR>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::clevr {

namespace {

constexpr int parameters = 5;
constexpr double lens = 35;
constexpr double sensor = 32;
/// How many pixels of error weigh like an error of one unit in the distance.
constexpr double pixels_per_unit = 30;

using Vector = Eigen::Vector<double, parameters>;

Vector to_vector(const CameraGuess& guess) {
  return {guess.position[0], guess.position[1], guess.position[2], guess.target[0],
          guess.target[1]};
}

CameraGuess to_guess(const Vector& vector) {
  return {{vector(0), vector(1), vector(2)}, {vector(3), vector(4)}};
}

} // namespace

geometry::Camera make_camera(const CameraGuess& guess, int width, int height,
                             double metres_per_unit) {
  const double half_height = height * sensor / (2 * lens * width);
  const double angle = 2 * std::atan(half_height) * 180 / std::numbers::pi;
  const Eigen::Vector3d eye(guess.position[0], guess.position[1], guess.position[2]);
  const Eigen::Vector3d target(guess.target[0], guess.target[1], 0);
  return geometry::look_at(geometry::to_point(metres_per_unit * eye),
                           geometry::to_point(metres_per_unit * target), angle, width, height);
}

std::string camera_file(const CameraGuess& guess, int width, int height, double metres_per_unit) {
  const geometry::Camera camera = make_camera(guess, width, height, metres_per_unit);
  std::ostringstream file;
  file.precision(std::numeric_limits<double>::max_digits10);
  file << "size " << width << ' ' << height << '\n'
       << "focal " << camera.fx << ' ' << camera.fy << '\n'
       << "eye";
  for (const double x : guess.position)
    file << ' ' << metres_per_unit * x;
  file << "\ntarget";
  for (const double x : guess.target)
    file << ' ' << metres_per_unit * x;
  file << " 0\n";
  return file.str();
}

CameraGuess fit_camera(std::span<const Scene* const> scenes, const CameraGuess& start,
                       double tolerance, int width, int height) {
  const Vector prior = to_vector(start);
  const auto errors = [&](const Vector& vector) {
    std::vector<double> result;
    const geometry::Camera camera = make_camera(to_guess(vector), width, height, 1);
    const Eigen::Vector3d eye = to_eigen(camera.pose.position);
    const Eigen::Vector3d forward = to_eigen(camera.pose.rotation) * Eigen::Vector3d::UnitZ();
    for (const auto* scene : scenes) {
      for (const auto& object : scene->objects) {
        const auto pixel = project(camera, object.position).value_or(geometry::Point2{});
        const double distance = (to_eigen(object.position) - eye).dot(forward);
        result.push_back(pixel.x - object.pixel.x);
        result.push_back(pixel.y - object.pixel.y);
        result.push_back(pixels_per_unit * (distance - object.distance));
      }
    }
    for (int i = 0; i < parameters; ++i)
      result.push_back((vector(i) - prior(i)) / (i < 3 ? tolerance : tolerance / 10));
    return Eigen::VectorXd(
      Eigen::VectorXd::Map(result.data(), static_cast<Eigen::Index>(result.size())));
  };
  // Gauss and Newton's method; it converges in a few steps from anywhere near.
  constexpr int steps = 15;
  constexpr double delta = 1e-5;
  Vector current = prior;
  for (int step = 0; step < steps; ++step) {
    const Eigen::VectorXd error = errors(current);
    Eigen::Matrix<double, Eigen::Dynamic, parameters> jacobian(error.size(), parameters);
    for (int i = 0; i < parameters; ++i) {
      Vector moved = current;
      moved(i) += delta;
      jacobian.col(i) = (errors(moved) - error) / delta;
    }
    current -= jacobian.householderQr().solve(error);
  }
  return to_guess(current);
}

} // namespace castor::clevr
