#pragma once

#include "castor/actors/system/inspection_context.hpp"
#include "castor/wm/filters/change_filter.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace castor {

/// Sends the changes of a system to a client outside of it, until the client ends the request
/// (`events`). The client is sent no more than it takes: the rest waits in the working memories,
/// which merge it.
class EventWatch {
public:
  /// The context has to outlive it.
  explicit EventWatch(InspectionContext& context) : context_(context) {}

  /// Throws for an invalid request.
  void begin(const Json& request);

  /// Subscribes at working memories that are new, once it has begun.
  void update();

  void on_event(const ChangeEventPtr& event);

  /// The client has taken everything that was sent.
  void taken();

private:
  struct Watched {
    WorkingMemoryActor actor;
    Receipts receipts;
    /// Events that were sent and not yet taken.
    std::uint64_t in_flight = 0;
  };

  void subscribe_to(const ChangeFilter& filter);
  std::vector<ChangeFilter> filters_for(const std::string& name) const;

  InspectionContext& context_;
  std::optional<ChangeFilter> filter_;
  /// Only entries of this id, or of this type.
  std::string what_;
  bool with_values_ = false;
  std::size_t max_bytes_ = shown_bytes;
  FilterId last_filter_ = 0;
  std::map<std::string, Watched> watched_;
};

} // namespace castor
