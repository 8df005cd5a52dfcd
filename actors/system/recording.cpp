#include "castor/actors/system/recording.hpp"

#include "castor/wm/entries/change_event.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

/// The first of them is taken first.
template <class Track, class Step>
void put_first(Track& track, std::vector<Step> steps) {
  std::reverse(steps.begin(), steps.end());
  track.first = std::move(steps);
}

template <class Track, class Step>
bool take_first(Track& track, std::optional<Step>& into) {
  if (track.first.empty())
    return false;
  into = std::move(track.first.back());
  track.first.pop_back();
  return true;
}

/// What is left of the time that an entry has, at a later time than that of its write.
EntryLife later(EntryLife life, UnixTime by) {
  if (life.time_to_live.count() > 0)
    life.time_to_live = std::max<Timestamp>(life.time_to_live - by, Timestamp{1});
  return life;
}

/// The entries that writes have led to, in the order in which they were written.
class Standing {
public:
  void apply(const RecordedWrite& write) {
    for (auto& x : write.changes) {
      if (auto place = places_.find(x.id); place != places_.end()) {
        entries_.erase(place->second);
        places_.erase(place);
      }
      if (x.operation == Operation::remove)
        continue;
      places_[x.id] = ++last_;
      entries_.emplace(last_, RecordedWrite{write.time, write.subarchitecture, write.source, {x}});
    }
  }

  /// As they stand at that time.
  std::vector<RecordedWrite> at(UnixTime time) {
    std::vector<RecordedWrite> result;
    for (auto& [number, x] : entries_) {
      auto& change = x.changes.front();
      change.operation = Operation::add;
      change.life = later(change.life, time - x.time);
      x.time = time;
      result.push_back(std::move(x));
    }
    return result;
  }

private:
  std::map<std::uint64_t, RecordedWrite> entries_;
  std::unordered_map<std::string, std::uint64_t> places_;
  std::uint64_t last_ = 0;
};

} // namespace

UnixTime time_of(const RecordedStep& x) {
  return std::visit([](auto& step) { return step.time; }, x);
}

Recording::Recording(const RecordingSelection& selection) : selection_(selection) {
  for (auto& x : selection.journals)
    open_journal(x);
  for (auto& x : selection.pushes)
    open_pushes(x);
}

void Recording::open_journal(const std::filesystem::path& file) {
  auto& track = journals_.emplace_back();
  track.reader = std::make_unique<JournalReader>(file);
  track.subarchitecture = track.reader->summary().subarchitecture;
  auto before = track.reader->begin().store();
  track.ahead = track.reader->next();
  std::vector<RecordedWrite> first;
  for (auto& x : before.entries) {
    track.writers[x.entry->address.id] = x.entry->writer;
    if (!is_wanted(x.entry->writer))
      continue;
    JournalRecord record;
    record.id = x.entry->address.id;
    record.type = x.entry->value.type_ptr();
    record.source = x.entry->writer;
    record.life = x.entry->life;
    record.value = x.entry->value;
    // What was there before the first change is there when the recording begins.
    auto time = track.ahead ? track.ahead->time : x.time;
    first.push_back({time, track.subarchitecture, record.source, {std::move(record)}});
  }
  put_first(track, std::move(first));
  skipping_ = true;
  fetch(track);
  skip(track);
  skipping_ = false;
}

void Recording::skip(JournalTrack& track) {
  Standing standing;
  while (track.write && track.write->time < selection_.from) {
    standing.apply(*track.write);
    fetch(track);
  }
  auto first = standing.at(selection_.from);
  if (track.write) {
    auto expired = [](auto& x) { return x.source == expiry_source; };
    std::erase_if(track.write->changes, expired);
    if (!track.write->changes.empty())
      first.push_back(*std::move(track.write));
    track.write.reset();
  }
  std::reverse(track.first.begin(), track.first.end());
  first.insert(first.end(), std::make_move_iterator(track.first.begin()),
               std::make_move_iterator(track.first.end()));
  put_first(track, std::move(first));
  skipping_ = false;
  fetch(track);
}

void Recording::open_pushes(const std::filesystem::path& file) {
  auto& track = pushes_.emplace_back();
  track.reader = std::make_unique<PushLogReader>(file);
  track.provider = track.reader->summary().provider;
  fetch(track);
  skip(track);
}

void Recording::skip(PushTrack& track) const {
  std::map<std::string, RecordedValue> last;
  while (track.value && track.value->time < selection_.from) {
    track.value->push.pushed = false;
    track.value->time = selection_.from;
    auto type = track.value->push.value.type_name();
    last[type] = *std::move(track.value);
    fetch(track);
  }
  std::vector<RecordedValue> first;
  for (auto& [type, value] : last)
    first.push_back(std::move(value));
  if (track.value)
    first.push_back(*std::exchange(track.value, std::nullopt));
  put_first(track, std::move(first));
  fetch(track);
}

std::optional<RecordedStep> Recording::next() {
  JournalTrack* write = nullptr;
  for (auto& x : journals_)
    if (x.write && (!write || x.write->time < write->write->time))
      write = &x;
  PushTrack* value = nullptr;
  for (auto& x : pushes_)
    if (x.value && (!value || x.value->time < value->value->time))
      value = &x;
  // What was handed out may be what was written because of it.
  if (value && (!write || value->value->time <= write->write->time)) {
    RecordedStep result = *std::exchange(value->value, std::nullopt);
    fetch(*value);
    return result;
  }
  if (!write)
    return std::nullopt;
  RecordedStep result = *std::exchange(write->write, std::nullopt);
  fetch(*write);
  return result;
}

void Recording::fetch(PushTrack& track) {
  if (take_first(track, track.value))
    return;
  track.value.reset();
  if (auto x = track.reader->next()) {
    auto time = x->time;
    track.value = {time, track.provider, *std::move(x)};
  }
}

void Recording::fetch(JournalTrack& track) {
  if (take_first(track, track.write))
    return;
  track.write.reset();
  while (track.ahead) {
    RecordedWrite write{track.ahead->time, track.subarchitecture, {}, {}};
    auto number = track.ahead->write;
    while (track.ahead && track.ahead->write == number) {
      take(track, *std::move(track.ahead), write);
      track.ahead = track.reader->next();
    }
    if (write.changes.empty())
      continue;
    track.write = std::move(write);
    return;
  }
}

void Recording::take(JournalTrack& track, JournalRecord record, RecordedWrite& into) {
  // The working memory sees to it itself.
  if (record.source == expiry_source && !skipping_)
    return;
  auto& writer = track.writers[record.id];
  if (record.source != owner_ended_source && record.source != expiry_source &&
      record.source != last_will_source)
    writer = record.source;
  if (!is_wanted(writer))
    return;
  into.source = writer;
  into.changes.push_back(std::move(record));
}

std::vector<RecordedPush> first_values(const std::filesystem::path& pushes, UnixTime from) {
  std::map<std::string, RecordedPush> result;
  PushLogReader first{pushes};
  for (auto& x : first.first_of_each_type())
    result[x.value.type_name()] = std::move(x);
  PushLogReader rest{pushes};
  for (auto x = rest.next(); x && x->time < from; x = rest.next())
    result[x->value.type_name()] = *std::move(x);
  std::vector<RecordedPush> values;
  for (auto& [type, x] : result)
    values.push_back(std::move(x));
  return values;
}

} // namespace castor
