#include <string>
#include <utility>

#include "castor/perception/vision/camera/image_source_kinds.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

namespace castor::vision {

namespace {

class SceneSource : public ImageSource {
public:
  SceneSource(const std::filesystem::path& path, const ImageSourceOptions& options)
    : clock_(options.clock), path_(path), text_(load(path)) {
    // nop
  }

  Frame next() override {
    const auto time = clock_();
    auto snapshot = text_.scene.at(time);
    const auto index = count_++;
    const bool changed = index == 0 || snapshot != shown_;
    // While nothing changes only the noise is new; the rest was rendered before.
    if (changed) {
      clean_ = render_without_noise(snapshot, text_.scene.camera);
      shown_ = std::move(snapshot);
    }
    Frame frame{clean_, time, index, changed};
    add_sensor_noise(frame.image, shown_.noise, shown_.seed, index);
    return frame;
  }

  Camera camera() const override { return text_.scene.camera; }

  std::string description() const override { return "scene " + path_.string(); }

  std::vector<std::string> warnings() const override {
    std::vector<std::string> result;
    for (const auto& problem : text_.problems)
      result.push_back(to_string(problem));
    return result;
  }

private:
  static TabletopSceneText load(const std::filesystem::path& path) {
    try {
      return load_tabletop_scene(path);
    } catch (const TextFileError& error) {
      throw ImageSourceError(ImageFault::bad_scene, path.string(),
                             "the scene has errors:\n" + std::string(error.what()),
                             "Correct them and start again.");
    }
  }

  std::function<std::chrono::microseconds()> clock_;
  std::filesystem::path path_;
  TabletopSceneText text_;
  TabletopSnapshot shown_;
  Image clean_;
  std::uint64_t count_ = 0;
};

} // namespace

std::unique_ptr<ImageSource> open_scene(const std::filesystem::path& path,
                                        const ImageSourceOptions& options) {
  return std::make_unique<SceneSource>(path, options);
}

} // namespace castor::vision
