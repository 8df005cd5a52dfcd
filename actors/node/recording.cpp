#include "castor/actors/node/recording.hpp"

#include "castor/wm/entry_store.hpp"

#include <algorithm>
#include <utility>

namespace castor {

Recording::Recording(const std::vector<std::filesystem::path>& files, std::set<std::string> sources)
  : sources_(std::move(sources)) {
  for (auto& file : files) {
    auto& track = tracks_.emplace_back();
    track.reader = std::make_unique<JournalReader>(file);
    track.subarchitecture = track.reader->summary().subarchitecture;
    auto before = track.reader->begin().store();
    track.ahead = track.reader->next();
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
      track.first.push_back({time, track.subarchitecture, record.source, {std::move(record)}});
    }
    std::reverse(track.first.begin(), track.first.end());
    fetch(track);
  }
}

std::optional<RecordedWrite> Recording::next() {
  Track* earliest = nullptr;
  for (auto& x : tracks_)
    if (x.write && (!earliest || x.write->time < earliest->write->time))
      earliest = &x;
  if (!earliest)
    return std::nullopt;
  auto result = std::exchange(earliest->write, std::nullopt);
  fetch(*earliest);
  return result;
}

void Recording::fetch(Track& track) {
  if (!track.first.empty()) {
    track.write = std::move(track.first.back());
    track.first.pop_back();
    return;
  }
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

void Recording::take(Track& track, JournalRecord record, RecordedWrite& into) {
  // The working memory sees to it itself.
  if (record.source == expiry_source)
    return;
  auto& writer = track.writers[record.id];
  if (record.source != owner_ended_source)
    writer = record.source;
  if (!is_wanted(writer))
    return;
  into.source = writer;
  into.changes.push_back(std::move(record));
}

} // namespace castor
