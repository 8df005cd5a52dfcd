#include "castor/tools/timeline/figure.hpp"

#include "castor/tools/timeline/summary.hpp"
#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/json.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace castor::timeline {

namespace {

using Json = nlohmann::ordered_json;

/// What people look at in a page; longer lists are cut.
constexpr std::size_t most_elements = 40;
constexpr std::size_t shown_bytes = 64;

void cut_lists(Json& x) {
  if (x.is_array() && x.size() > most_elements) {
    auto more = x.size() - most_elements;
    x.erase(x.begin() + static_cast<std::ptrdiff_t>(most_elements), x.end());
    x.push_back(fmt::format("... and {} more", more));
  }
  if (x.is_structured())
    for (auto& y : x)
      cut_lists(y);
}

class Maker {
public:
  Maker(Figure& figure, const PictureMaker& picture) : figure_(figure), picture_(picture) {}

  void make(const Stages& stages) {
    for (auto& stage : stages.list())
      for (auto& [address, x] : stage.changed)
        know(address, x);
    number_entries();
    for (auto& stage : stages.list()) {
      figure_.columns.push_back({stage.begin, stage.end});
      add(stage);
    }
    lay_out_cells();
  }

private:
  struct Present {
    std::size_t version;
    Fate fate;
  };

  void know(const Address& address, const ChangedEntry& x) {
    links_.know(address);
    if (std::ranges::find(figure_.rows, address.subarchitecture) == figure_.rows.end())
      figure_.rows.push_back(address.subarchitecture);
    auto [i, first] = first_seen_.try_emplace(address, Seen{x.since, x.type});
    if (!first)
      i->second.time = std::min(i->second.time, x.since);
  }

  /// In the order in which they came.
  void number_entries() {
    std::vector<std::pair<Timestamp, Address>> order;
    for (auto& [address, x] : first_seen_)
      order.emplace_back(x.time, address);
    std::ranges::sort(order);
    for (auto& [time, address] : order) {
      numbers_[address] = figure_.entries.size();
      figure_.entries.push_back({address, first_seen_.at(address).type});
    }
  }

  void add(const Stage& stage) {
    for (auto i = present_.begin(); i != present_.end();) {
      i->second.fate = Fate::unchanged;
      i = gone_.count(i->first) > 0 ? present_.erase(i) : std::next(i);
    }
    gone_.clear();
    for (auto& [address, x] : stage.changed) {
      auto number = numbers_.at(address);
      auto i = present_.find(number);
      bool was_there = i != present_.end();
      if (x.is_gone) {
        gone_.insert(number);
        if (was_there)
          i->second.fate = Fate::gone;
        else
          present_[number] = {add_version(number, x), Fate::passed};
      } else {
        present_[number] = {add_version(number, x), was_there ? Fate::changed : Fate::added};
      }
    }
    states_.push_back(present_);
  }

  std::size_t add_version(std::size_t number, const ChangedEntry& x) {
    EntryVersion result;
    result.entry = number;
    result.version = x.version;
    result.writer = x.writer;
    result.time = x.time;
    if (x.value.has_value())
      add_content(result, x.value);
    figure_.versions.push_back(std::move(result));
    return figure_.versions.size() - 1;
  }

  void add_content(EntryVersion& into, const Value& value) {
    auto contents = contents_of(value);
    for (auto& x : links_.of(figure_.entries[into.entry].address, contents))
      into.links.push_back(numbers_.at(x));
    add_pictures(into, std::move(contents.pictures));
    try {
      JsonOptions options;
      options.max_bytes = shown_bytes;
      auto json = Json::parse(to_json(value, options));
      into.summary = summary(json, [this](const std::string& x) { return links_.is_id(x); });
      cut_lists(json);
      into.json = json.dump();
    } catch (const DecodeError& e) {
      into.summary = {e.what()};
    }
  }

  void add_pictures(EntryVersion& into, std::vector<PictureView> pictures) {
    std::ranges::stable_sort(pictures, std::greater{},
                             [](const PictureView& x) { return x.bytes.size(); });
    for (auto& x : pictures) {
      bool is_large = x.width >= large_from;
      auto made = picture_(x, is_large ? large_picture_width : small_picture,
                           is_large ? large_picture_height : small_picture);
      if (!made)
        continue;
      into.pictures.push_back(figure_.pictures.size());
      figure_.pictures.push_back(*std::move(made));
    }
  }

  void lay_out_cells() {
    figure_.cells.resize(figure_.rows.size() * figure_.columns.size());
    for (std::size_t column = 0; column < states_.size(); ++column)
      for (auto& [number, x] : states_[column]) {
        auto& name = figure_.entries[number].address.subarchitecture;
        auto row =
          static_cast<std::size_t>(std::ranges::find(figure_.rows, name) - figure_.rows.begin());
        figure_.cells[row * figure_.columns.size() + column].push_back({x.version, x.fate});
      }
  }

  struct Seen {
    Timestamp time;
    std::string type;
  };

  Figure& figure_;
  const PictureMaker& picture_;
  Links links_;
  std::map<Address, Seen> first_seen_;
  std::map<Address, std::size_t> numbers_;
  /// What is there in the stage that is looked at, by number, and what goes with it.
  std::map<std::size_t, Present> present_;
  std::set<std::size_t> gone_;
  std::vector<std::map<std::size_t, Present>> states_;
};

} // namespace

Figure make_figure(std::string title, std::vector<std::string> rows, const Stages& stages,
                   const PictureMaker& picture) {
  Figure result;
  result.title = std::move(title);
  result.rows = std::move(rows);
  Maker{result, picture}.make(stages);
  return result;
}

} // namespace castor::timeline
