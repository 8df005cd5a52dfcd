#pragma once

#include "castor/perception/vision/types.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::vision {

struct TrackingOptions {
  /// Number of pictures in a row without an object after which it is lost.
  int max_missing = 5;
  /// Below the first similarity a box does not show the object, from the second on another place in
  /// the picture does; see Appearance::similarity.
  double min_similarity = 0.4;
  double found_similarity = 0.65;
  /// An object has not moved if at most this share of the pixels in and around its box differ by
  /// more than this number of grey levels.
  double still_share = 0.0005;
  int pixel_threshold = 20;
};

/// Tracked position of an object.
struct Track {
  std::string name;
  /// Its box in the picture; while it is missing, the last one.
  ImageBox box;
  /// Similarity to its first appearance, 0 to 1.
  double similarity = 1;
  /// Number of pictures in a row, up to this one, without the object.
  int missing = 0;
  /// It was missing for too long, and is not tracked any more.
  bool is_lost = false;
};

/// Tracks objects from one picture to the next by discriminative correlation filters (CSRT; A.
/// Lukezic et al., "Discriminative correlation filter with channel and spatial reliability", 2017),
/// which is exact, but searches around the last position only. So the box found is compared with
/// the object's first colour histogram; if they differ, the whole picture is searched.
class BoxTracker {
public:
  explicit BoxTracker(TrackingOptions options = {});
  BoxTracker(BoxTracker&&) noexcept;
  BoxTracker& operator=(BoxTracker&&) noexcept;
  ~BoxTracker();

  /// Tracks an object from the next picture on; replaces a tracked object of this name.
  ///
  /// \param region the pixels of its box, 3 channels.
  /// \param mask mask of the object; all pixels if it is empty.
  /// \throws std::invalid_argument as Appearance does.
  void follow(const std::string& name, const ImageBox& box, const Image& region,
              const Image& mask = {});

  void forget(const std::string& name);

  bool follows(const std::string& name) const { return things_.count(name) > 0; }

  /// Positions of all objects in this picture, sorted by name.
  std::vector<Track> update(const Image& picture);

private:
  struct Thing;

  TrackingOptions options_;
  std::map<std::string, std::unique_ptr<Thing>> things_;
};

} // namespace castor::vision
