#pragma once

#include "castor/perception/vision/types.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace castor::vision {

struct TrackingOptions {
  /// A thing that is not seen in this many pictures in a row is lost.
  int max_missing = 5;
  /// A box that looks less like the thing than this does not show it, and another place that looks
  /// at least this much like it does; see Appearance::similarity.
  double min_similarity = 0.4;
  double found_similarity = 0.65;
  /// Where no more than this share of the pixels in and around a box differ by more than so many
  /// grey levels, nothing has moved.
  double still_share = 0.0005;
  int pixel_threshold = 20;
};

/// Where a thing is by now.
struct Track {
  std::string name;
  /// While it is missing, where it was seen last.
  ImageBox box;
  /// How much of its first looks it has there, 0 to 1.
  double similarity = 1;
  /// In how many pictures, up to this one, it was not seen.
  int missing = 0;
  /// It has been missing for too long, and is not followed any more.
  bool is_lost = false;
};

/// Follows things through pictures: from one to the next by discriminative correlation filters
/// (CSRT; A. Lukezic et al., "Discriminative correlation filter with channel and spatial
/// reliability", 2017), which is exact and knows nothing but the last place. So what is in the box
/// then is compared with the colours that the thing had at first; where it has others, the thing is
/// looked for all over the picture.
class BoxTracker {
public:
  explicit BoxTracker(TrackingOptions options = {});
  BoxTracker(BoxTracker&&) noexcept;
  BoxTracker& operator=(BoxTracker&&) noexcept;
  ~BoxTracker();

  /// Follows a thing from the next picture on; anew, if a thing of this name is followed already.
  ///
  /// \param region the pixels of the box that it was seen in, 3 channels.
  /// \param mask which of them are the thing's; all, if it is empty.
  /// \throws std::invalid_argument as Appearance does.
  void follow(const std::string& name, const ImageBox& box, const Image& region,
              const Image& mask = {});

  void forget(const std::string& name);

  bool follows(const std::string& name) const { return things_.count(name) > 0; }

  /// Where everything is in this picture; by name.
  std::vector<Track> update(const Image& picture);

private:
  struct Thing;

  TrackingOptions options_;
  std::map<std::string, std::unique_ptr<Thing>> things_;
};

} // namespace castor::vision
