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

/// Tells somebody outside of a system of its changes, for as long as he wants to know (`events`).
/// He is sent no more than he has taken: the rest waits in the working memories, which merge it.
class EventWatch {
public:
  /// The context has to outlive it.
  explicit EventWatch(InspectionContext& context) : context_(context) {}

  /// Throws where the request makes no sense.
  void begin(const Json& request);

  /// Subscribes at working memories that are new, once it has begun.
  void update();

  void hear(const ChangeEventPtr& event);

  /// Everything that was said was taken.
  void taken();

private:
  struct Watched {
    WorkingMemoryActor actor;
    Receipts receipts;
    /// Events that were said and not yet taken.
    std::uint64_t told = 0;
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
