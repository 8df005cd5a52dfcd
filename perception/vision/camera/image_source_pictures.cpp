#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>
#include <utility>

#include "castor/perception/vision/camera/image_source_kinds.hpp"

namespace castor::vision {

namespace {

class StillSource : public ImageSource {
public:
  StillSource(const std::filesystem::path& path, const ImageSourceOptions& options)
    : options_(options), path_(path), image_(read_image(path, options.limits)) {
    // nop
  }

  Frame next() override {
    const auto index = count_++;
    return {image_, options_.clock(), index, index == 0};
  }

  Camera camera() const override {
    return camera_for(options_, static_cast<int>(image_.width), static_cast<int>(image_.height));
  }

  std::string description() const override { return "picture " + path_.string(); }

private:
  ImageSourceOptions options_;
  std::filesystem::path path_;
  Image image_;
  std::uint64_t count_ = 0;
};

/// Whether `a` comes before `b` for a person: numbers within the names count as numbers.
bool naturally_before(std::string_view a, std::string_view b) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto take_number = [&](std::string_view& text) {
    std::size_t length = 0;
    while (length < text.size() && is_digit(text[length]))
      ++length;
    auto digits = text.substr(0, length);
    text.remove_prefix(length);
    digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
    return digits;
  };
  const auto whole_a = a;
  const auto whole_b = b;
  while (!a.empty() && !b.empty()) {
    if (is_digit(a.front()) && is_digit(b.front())) {
      const auto number_a = take_number(a);
      const auto number_b = take_number(b);
      if (number_a.size() != number_b.size())
        return number_a.size() < number_b.size();
      if (number_a != number_b)
        return number_a < number_b;
    } else {
      if (lower(a.front()) != lower(b.front()))
        return lower(a.front()) < lower(b.front());
      a.remove_prefix(1);
      b.remove_prefix(1);
    }
  }
  if (a.empty() != b.empty())
    return a.empty();
  return whole_a < whole_b;
}

class FolderSource : public ImageSource {
public:
  FolderSource(const std::filesystem::path& path, const ImageSourceOptions& options)
    : options_(options), path_(path) {
    std::error_code error;
    std::filesystem::directory_iterator entries(path, error);
    for (; !error && entries != std::filesystem::directory_iterator(); entries.increment(error)) {
      std::error_code ignored;
      if (entries->is_regular_file(ignored) && has_image_extension(entries->path()))
        files_.push_back(entries->path());
    }
    if (error)
      throw ImageSourceError(ImageFault::unreadable, path.string(),
                             "the folder cannot be read (" + error.message() + ")",
                             "Check that you may read it.");
    if (files_.empty())
      throw ImageSourceError(ImageFault::empty_folder, path.string(),
                             "there are no pictures in this folder",
                             "Put PNG or JPEG files into it or name another folder.");
    std::sort(files_.begin(), files_.end(), [](const auto& a, const auto& b) {
      return naturally_before(a.filename().string(), b.filename().string());
    });
    prepare_camera();
  }

  Frame next() override {
    const bool hold = next_file_ == files_.size() &&
                      options_.at_end == ImageSourceOptions::AtEnd::hold_last &&
                      !last_.bytes.empty();
    if (hold || (files_.size() == 1 && !last_.bytes.empty()))
      return {last_, options_.clock(), count_++, false};
    const auto& file = files_[next_file_ % files_.size()];
    next_file_ = next_file_ % files_.size() + 1;
    try {
      last_ = read_image(file, options_.limits);
    } catch (const ImageSourceError& error) {
      ++failures_;
      if (failures_ >= files_.size())
        throw ImageSourceError(error.fault(), path_.string(),
                               "none of the folder's pictures can be read; the last one: " +
                                 std::string(error.what()),
                               "Replace the pictures or name another folder.");
      throw ImageSourceError(ImageFault::frame_lost, error.source(),
                             "a picture of the folder cannot be read: " + std::string(error.what()),
                             "The next picture follows; remove or replace this one.");
    }
    failures_ = 0;
    return {last_, options_.clock(), count_++, true};
  }

  Camera camera() const override {
    if (last_.bytes.empty())
      return first_camera_;
    return camera_for(options_, static_cast<int>(last_.width), static_cast<int>(last_.height));
  }

  std::string description() const override {
    return "folder " + path_.string() + " with " + std::to_string(files_.size()) +
           (files_.size() == 1 ? " picture" : " pictures");
  }

private:
  /// For the size of the first picture that can be read.
  void prepare_camera() {
    constexpr int usual_width = 640;
    constexpr int usual_height = 480;
    first_camera_ = camera_for(options_, usual_width, usual_height);
    for (const auto& file : files_) {
      try {
        const Image image = read_image(file, options_.limits);
        first_camera_ =
          camera_for(options_, static_cast<int>(image.width), static_cast<int>(image.height));
        return;
      } catch (const ImageSourceError&) {
        // It is reported when it is this picture's turn.
        continue;
      }
    }
  }

  ImageSourceOptions options_;
  std::filesystem::path path_;
  std::vector<std::filesystem::path> files_;
  std::size_t next_file_ = 0;
  /// In a row.
  std::size_t failures_ = 0;
  std::uint64_t count_ = 0;
  Image last_;
  Camera first_camera_;
};

} // namespace

std::unique_ptr<ImageSource> open_still(const std::filesystem::path& path,
                                        const ImageSourceOptions& options) {
  return std::make_unique<StillSource>(path, options);
}

std::unique_ptr<ImageSource> open_folder(const std::filesystem::path& path,
                                         const ImageSourceOptions& options) {
  return std::make_unique<FolderSource>(path, options);
}

} // namespace castor::vision
