#include "castor/perception/vision/camera/camera_model_file.hpp"

#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "castor/base/suggestion.hpp"
#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::vision {

using namespace geometry;

namespace {

constexpr int max_pixels_per_side = 100'000;

const std::array<std::string, 9> settings{"size",   "focal",  "fov",        "centre", "eye",
                                          "target", "number", "distortion", "frame"};

/// One reading of one file: collects what the lines say and what is wrong with them.
class CameraReader {
public:
  explicit CameraReader(std::string file_name) : file_name_(std::move(file_name)) {
    // nop
  }

  CameraText read(std::string_view text) {
    for (const auto& line : text_lines(text))
      read_line(line);
    CameraText result;
    auto camera = assemble();
    result.problems = std::move(problems_);
    if (!has_errors(result.problems))
      result.camera = camera;
    return result;
  }

private:
  struct Setting {
    TextLine line;
    std::vector<double> numbers;
  };

  void report(const TextLine& line, std::string message, std::string remedy) {
    problems_.push_back(
      finding(Severity::error, file_name_, line, std::move(message), std::move(remedy)));
  }

  void read_line(const TextLine& line) {
    const std::string keyword = line.words[0] == "center" ? "centre" : line.words[0];
    if (seen_.contains(keyword)) {
      report(line, "\"" + keyword + "\" is given twice",
             "Remove this line or line " + std::to_string(seen_.at(keyword).line.number) + ".");
      return;
    }
    if (keyword == "size")
      read_numbers(line, keyword, 2, "size 640 480");
    else if (keyword == "focal")
      read_numbers(line, keyword, 2, "focal 612.4 611.9");
    else if (keyword == "fov")
      read_numbers(line, keyword, 1, "fov 45");
    else if (keyword == "centre")
      read_numbers(line, keyword, 2, "centre 319.5 239.5");
    else if (keyword == "eye")
      read_numbers(line, keyword, 3, "eye 0 -0.9 0.7");
    else if (keyword == "target")
      read_numbers(line, keyword, 3, "target 0 0 0");
    else if (keyword == "number")
      read_numbers(line, keyword, 1, "number 0");
    else if (keyword == "frame")
      read_frame(line);
    else if (keyword == "distortion")
      read_distortion(line);
    else
      report_unknown(line, keyword);
  }

  void report_unknown(const TextLine& line, const std::string& keyword) {
    const auto guess = did_you_mean(keyword, {settings.begin(), settings.end()});
    report(line, "\"" + keyword + "\" is no setting of a camera",
           !guess.empty()
             ? guess
             : "The settings are size, focal, fov, centre, distortion, eye, target, number and "
               "frame.");
  }

  void read_numbers(const TextLine& line, const std::string& keyword, std::size_t count,
                    const std::string& example) {
    const bool lengths = keyword == "eye" || keyword == "target";
    Setting setting{line, {}};
    bool good = line.words.size() == count + 1;
    for (std::size_t i = 1; good && i < line.words.size(); ++i) {
      const auto number = lengths ? parse_length(line.words[i]) : parse_number(line.words[i]);
      good = number.has_value();
      setting.numbers.push_back(number.value_or(0));
    }
    if (!good) {
      report(line,
             "\"" + keyword + "\" takes " + std::to_string(count) +
               (count == 1 ? " number" : " numbers"),
             "Write it like this: " + example);
      setting.numbers.clear();
    }
    seen_.emplace(keyword, std::move(setting));
  }

  void read_frame(const TextLine& line) {
    if (line.words.size() == 2)
      frame_ = line.words[1];
    else
      report(line, "\"frame\" takes one name",
             "Write the name of the frame that eye and target are given in: frame table");
    seen_.emplace("frame", Setting{line, {}});
  }

  void read_distortion(const TextLine& line) {
    const std::map<std::string, double*> names{{"k1", &camera_.k1},
                                               {"k2", &camera_.k2},
                                               {"k3", &camera_.k3},
                                               {"t1", &camera_.t1},
                                               {"t2", &camera_.t2}};
    bool good = line.words.size() > 1 && line.words.size() % 2 == 1;
    for (std::size_t i = 1; good && i < line.words.size(); i += 2) {
      const auto coefficient = names.find(line.words[i]);
      const auto number = parse_number(line.words[i + 1]);
      good = coefficient != names.end() && number;
      if (good)
        *coefficient->second = *number;
    }
    if (!good)
      report(line, "\"distortion\" takes pairs of a name and a number",
             "Write it like this, with any of k1 k2 k3 t1 t2: distortion k1 -0.21 k2 0.06");
    seen_.emplace("distortion", Setting{line, {}});
  }

  /// The numbers of a required setting; null if it is not there or was reported as wrong.
  const Setting* required(const std::string& keyword, const std::string& example) {
    const auto setting = seen_.find(keyword);
    if (setting == seen_.end()) {
      report({}, "there is no \"" + keyword + "\" line", "Add one, for example: " + example);
      return nullptr;
    }
    return optional(keyword);
  }

  const Setting* optional(const std::string& keyword) const {
    const auto setting = seen_.find(keyword);
    return setting == seen_.end() || setting->second.numbers.empty() ? nullptr : &setting->second;
  }

  Camera assemble() {
    const Setting* size = required("size", "size 640 480");
    const Setting* eye = required("eye", "eye 0 -0.9 0.7");
    const Setting* target = required("target", "target 0 0 0");
    set_size(size);
    set_focal();
    if (const Setting* centre = optional("centre")) {
      camera_.cx = centre->numbers[0];
      camera_.cy = centre->numbers[1];
    }
    if (const Setting* number = optional("number")) {
      if (number->numbers[0] != std::floor(number->numbers[0]) || number->numbers[0] < 0 ||
          number->numbers[0] > 1000)
        report(number->line, "a camera's number is a whole number from 0 to 1000",
               "Number the cameras 0, 1, 2, ...");
      else
        camera_.number = static_cast<std::int32_t>(number->numbers[0]);
    }
    if (eye != nullptr && target != nullptr)
      set_pose(*eye, *target);
    return camera_;
  }

  void set_size(const Setting* size) {
    if (size == nullptr)
      return;
    for (const double side : size->numbers)
      if (side != std::floor(side) || side < 1 || side > max_pixels_per_side) {
        report(size->line, "the size is given in whole pixels, from 1 to 100000",
               "Write the width and height of the camera's images: size 640 480");
        return;
      }
    camera_.width = static_cast<std::int32_t>(size->numbers[0]);
    camera_.height = static_cast<std::int32_t>(size->numbers[1]);
    camera_.cx = (camera_.width - 1) / 2.0;
    camera_.cy = (camera_.height - 1) / 2.0;
  }

  void set_focal() {
    const bool has_focal = seen_.contains("focal");
    const bool has_fov = seen_.contains("fov");
    if (has_focal == has_fov)
      report(has_fov ? seen_.at("fov").line : TextLine{},
             has_fov ? "there are both a \"focal\" and a \"fov\" line"
                     : "there is neither a \"focal\" nor a \"fov\" line",
             "Give one of them: the calibrated \"focal 612.4 611.9\" (pixels) or, as a guess, "
             "\"fov 45\" (degrees from the upper to the lower edge).");
    if (const Setting* focal = optional("focal")) {
      if (!(focal->numbers[0] > 0 && focal->numbers[1] > 0))
        report(focal->line, "focal lengths are positive",
               "Write fx and fy in pixels: focal 612.4 611.9");
      camera_.fx = focal->numbers[0];
      camera_.fy = focal->numbers[1];
    }
    if (const Setting* fov = optional("fov")) {
      const double degrees = fov->numbers[0];
      if (!(degrees > 0 && degrees < 180))
        report(fov->line, "a field of view is between 0 and 180 degrees", "Common are 40 to 70.");
      else if (camera_.height > 0)
        camera_.fx = camera_.fy =
          look_at({0, 0, 1}, {0, 0, 0}, degrees, camera_.width, camera_.height).fx;
    }
  }

  void set_pose(const Setting& eye_setting, const Setting& target_setting) {
    const auto& e = eye_setting.numbers;
    const auto& t = target_setting.numbers;
    const Point3 eye{e[0], e[1], e[2]};
    const Point3 target{t[0], t[1], t[2]};
    if (!((to_eigen(target) - to_eigen(eye)).norm() > 0))
      report(target_setting.line, "eye and target are the same point",
             "Let the target be a point on the table in the middle of the image.");
    else
      camera_.pose = look_at(eye, target, 45, 1, 1, frame_).pose;
  }

  std::string file_name_;
  std::map<std::string, Setting> seen_;
  std::vector<Diagnostic> problems_;
  Camera camera_;
  std::string frame_ = table_frame;
};

} // namespace

CameraText parse_camera(std::string_view text, const std::string& file_name) {
  return CameraReader(file_name).read(text);
}

Camera load_camera(const std::filesystem::path& path) {
  auto result = parse_camera(load_text(path), path.string());
  if (!result.camera)
    throw TextFileError(std::move(result.problems));
  return *result.camera;
}

} // namespace castor::vision
