#include <sys/stat.h>

#include <optional>
#include <string>
#include <utility>

#include "castor/perception/vision/camera/image_source_kinds.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"

namespace castor::vision {

namespace {

/// What tells a file from the same one as it was before somebody edited it.
struct FileStamp {
  ino_t number = 0;
  off_t size = 0;
  time_t seconds = 0;
  long nanoseconds = 0;

  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Nothing if there is no such file, as while an editor replaces it.
std::optional<FileStamp> stamp_of(const std::filesystem::path& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    return std::nullopt;
  return FileStamp{status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

/// Shows the scene as its file says now: whoever edits the file sees what comes of it. Its time
/// goes on meanwhile.
class SceneSource : public ImageSource {
public:
  SceneSource(const std::filesystem::path& path, const ImageSourceOptions& options)
    : clock_(options.clock), path_(path), stamp_(stamp_of(path)), text_(load(path)) {
    // nop
  }

  Frame next() override {
    const bool is_edited = read_if_edited();
    const auto time = clock_();
    auto snapshot = text_.scene.at(time);
    const auto index = count_++;
    const bool changed = index == 0 || is_edited || snapshot != shown_;
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
      result.push_back(render(problem));
    return result;
  }

private:
  /// Whether the scene is another one now.
  bool read_if_edited() {
    auto stamp = stamp_of(path_);
    if (!stamp || stamp == stamp_)
      return false;
    // What has errors is not read again before it is edited again.
    stamp_ = stamp;
    try {
      text_ = load_tabletop_scene(path_);
    } catch (const TextFileError& error) {
      throw ImageSourceError(ImageFault::bad_edit, path_.string(),
                             "the scene was edited and has errors:\n" + std::string(error.what()),
                             "Correct them; until then it is shown as it was");
    }
    return true;
  }

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
  std::optional<FileStamp> stamp_;
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
