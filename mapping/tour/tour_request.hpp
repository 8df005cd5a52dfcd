#pragma once

#include "castor/communication/types.hpp"

#include <optional>
#include <string>

namespace castor::mapping {

enum class TourWish {
  /// "This is the kitchen", "we are in the kitchen": the place here is called so.
  name_place,
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

/// What a dialogue move asks for; nothing if it is about something else. What is denied ("this is
/// not the kitchen"), and what more than a name is said of ("the red kitchen"), names no place.
std::optional<TourRequest> tour_request(const communication::DialogueMove& move);

/// Sentence in reply to a directive.
/// @param request nothing if the directive is about something else
/// @param is_known whether there is a place of the name
std::string reply_to(const std::optional<TourRequest>& request, bool is_known);

} // namespace castor::mapping
