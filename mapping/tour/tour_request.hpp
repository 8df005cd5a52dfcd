#pragma once

#include "castor/communication/types.hpp"

#include <optional>
#include <string>

namespace castor::mapping {

enum class TourWish {
  /// "Go to the kitchen."
  go,
  /// "Follow me."
  follow,
  /// "Stop."
  stop
};

/// What somebody who shows a robot around wants of it.
struct TourRequest {
  TourWish wish = TourWish::stop;
  /// Name of the place, "kitchen"; empty where none is needed.
  std::string place;

  friend bool operator==(const TourRequest&, const TourRequest&) = default;
};

/// What a directive asks for; nothing if it is about something else, or if more than a name is said
/// of the place ("the red kitchen").
std::optional<TourRequest> tour_request(const communication::DialogueMove& move);

/// Sentence in reply to a directive.
/// @param request nothing if the directive is about something else
/// @param is_known whether there is a place of the name
std::string reply_to(const std::optional<TourRequest>& request, bool is_known);

} // namespace castor::mapping
