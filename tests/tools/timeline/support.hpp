#pragma once

#include "castor/tools/timeline/figure.hpp"
#include "castor/tools/timeline/stages.hpp"
#include "castor/wm/values/reflect.hpp"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::timeline::test {

using namespace std::chrono_literals;

/// Refers to others by id.
struct Note {
  std::string text;
  std::vector<std::string> about;
};
CASTOR_REFLECT(Note, text, about)

/// Refers to another by address.
struct Pointer {
  Address address;
};
CASTOR_REFLECT(Pointer, address)

struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 3;
  std::vector<std::uint8_t> bytes;
};
CASTOR_REFLECT(Image, width, height, channels, bytes)

struct Sight {
  std::vector<Image> views;
  Pointer of;
  std::vector<double> numbers;
};
CASTOR_REFLECT(Sight, views, of, numbers)

inline Image image(std::uint32_t width, std::uint32_t height, std::uint32_t channels = 3) {
  return {width, height, channels, std::vector<std::uint8_t>(width * height * channels, 7)};
}

/// What happens in working memories, told to stages.
class Story {
public:
  explicit Story(StageOptions options = {}) : stages(options) {}

  /// Adds the entry, or overwrites it.
  template <class T>
  Story& write(Timestamp time, const std::string& subarchitecture, const std::string& id, T value) {
    auto [i, first] = versions_.try_emplace({subarchitecture, id}, 0);
    bool was_there = !first && present_[{subarchitecture, id}];
    auto entry = std::make_shared<Entry>();
    entry->address = {subarchitecture, id};
    entry->version = first ? 0 : ++i->second;
    entry->value = Value::of(std::move(value));
    entry->writer = "writer";
    auto event = event_of(time, *entry);
    event.operation = was_there ? Operation::overwrite : Operation::add;
    present_[entry->address] = true;
    types_[entry->address] = event.type;
    stages.add(event, entry);
    return *this;
  }

  Story& write(Timestamp time, const std::string& subarchitecture, const std::string& id) {
    return write(time, subarchitecture, id, Note{});
  }

  Story& remove(Timestamp time, const std::string& subarchitecture, const std::string& id) {
    ChangeEvent event;
    event.operation = Operation::remove;
    event.address = {subarchitecture, id};
    event.type = types_.at(event.address);
    event.time = time;
    event.version = versions_.at(event.address);
    present_[event.address] = false;
    stages.add(event, nullptr);
    return *this;
  }

  static ChangeEvent event_of(Timestamp time, const Entry& entry) {
    ChangeEvent event;
    event.address = entry.address;
    event.source = entry.writer;
    event.type = entry.value.type_ptr();
    event.version = entry.version;
    event.time = time;
    return event;
  }

  /// The addresses of what changed, stage by stage; with a minus what is gone.
  std::vector<std::vector<std::string>> changes() const {
    std::vector<std::vector<std::string>> result;
    for (auto& stage : stages.list()) {
      auto& list = result.emplace_back();
      for (auto& [address, x] : stage.changed)
        list.push_back((x.is_gone ? "-" : "") + to_string(address));
    }
    return result;
  }

  Stages stages;

private:
  std::map<Address, Version> versions_;
  std::map<Address, bool> present_;
  std::map<Address, TypeDescriptorPtr> types_;
};

/// Pictures as they are, without their pixels.
inline std::optional<EmbeddedPicture> unchanged(const PictureView& x, double, double) {
  return EmbeddedPicture{static_cast<double>(x.width), static_cast<double>(x.height), "data:,"};
}

inline Figure figure_of(const Story& story, std::vector<std::string> rows = {}) {
  return make_figure("a run", std::move(rows), story.stages, unchanged);
}

} // namespace castor::timeline::test
