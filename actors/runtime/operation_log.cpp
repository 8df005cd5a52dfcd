#include "castor/actors/runtime/operation_log.hpp"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>

namespace castor {

namespace {

using Json = nlohmann::json;

std::int64_t nanoseconds(OperationRecorder::Clock::time_point x) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(x.time_since_epoch()).count();
}

std::uint64_t hash(const Value& x) {
  auto& bytes = x.bytes();
  return std::hash<std::string_view>{}({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

const char* name_of(Operation x) {
  switch (x) {
    case Operation::add:
      return "add";
    case Operation::overwrite:
      return "overwrite";
    default:
      return "remove";
  }
}

} // namespace

OperationLog::OperationLog(const std::filesystem::path& folder) {
  // A process has several if it takes part in a system several times.
  static std::atomic<int> count{0};
  auto path =
    folder / (std::to_string(getpid()) + '-' + std::to_string(++count) + OperationLog::extension);
  file_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0)
    throw std::system_error(errno, std::generic_category(), "cannot write " + path.string());
}

OperationLog::~OperationLog() {
  close(file_);
}

void OperationLog::write(std::string line) {
  line += '\n';
  // In one piece, so that the lines of several threads do not mix.
  [[maybe_unused]] auto written = ::write(file_, line.data(), line.size());
}

class OperationRecorder::Line : public Json {
public:
  using Json::Json;
};

OperationRecorder::Line OperationRecorder::begin_line(std::string_view operation,
                                                      const Address& address,
                                                      Clock::time_point since) {
  Line result;
  result["begin"] = log_.next();
  result["at"] = nanoseconds(since);
  result["component"] = client_->component;
  result["life"] = client_->incarnation;
  result["do"] = operation;
  result["where"] = address.subarchitecture;
  result["id"] = address.id;
  return result;
}

OperationRecorder::Line OperationRecorder::begin_write(const WriteRequest& x) {
  auto result = begin_line(name_of(x.operation), x.address);
  if (x.operation != Operation::remove)
    result["content"] = hash(x.value);
  if (x.last_seen)
    result["seen"] = *x.last_seen;
  result["expected"] = x.expected;
  result["token"] = x.token;
  result["has_life"] =
    x.last_will || (x.life && (x.life->time_to_live.count() > 0 || x.life->ephemeral ||
                               x.life->only_once || x.life->writable_by_all));
  return result;
}

void OperationRecorder::obeys(const std::string& type, const Client& commander, LeaseToken token,
                              const Address* lease) {
  Line line;
  line["obeys"] = client_->component;
  line["at"] = nanoseconds(Clock::now());
  line["type"] = type;
  line["component"] = commander.component;
  line["life"] = commander.incarnation;
  line["token"] = token;
  if (lease) {
    line["where"] = lease->subarchitecture;
    line["id"] = lease->id;
  }
  write(line);
}

void OperationRecorder::rests(const std::string& type) {
  Line line;
  line["rests"] = client_->component;
  line["at"] = nanoseconds(Clock::now());
  line["type"] = type;
  write(line);
}

void OperationRecorder::executes(const std::string& type, const Address& action) {
  Line line;
  line["executes"] = client_->component;
  line["at"] = nanoseconds(Clock::now());
  line["life"] = client_->incarnation;
  line["type"] = type;
  line["where"] = action.subarchitecture;
  line["id"] = action.id;
  write(line);
}

void OperationRecorder::write(const Line& x) {
  log_.write(x.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::uint64_t OperationRecorder::write_begin(const Line& x) {
  write(x);
  return x.at("begin").get<std::uint64_t>();
}

OperationRecorder::Open OperationRecorder::begin(const WriteRequest& x) {
  return {.numbers = {write_begin(begin_write(x))}};
}

OperationRecorder::Open OperationRecorder::begin(const BatchRequest& x) {
  Open result;
  for (auto& y : x.writes) {
    result.numbers.push_back(write_begin(begin_write(y)));
    result.where.push_back(y.address);
  }
  return result;
}

OperationRecorder::Open OperationRecorder::begin(const ReadRequest& x) {
  return {.numbers = {write_begin(begin_line("read", x.address))}};
}

OperationRecorder::Open OperationRecorder::begin(const LockRequest& x) {
  auto line = begin_line(x.patience.at_most.count() > 0 ? "lock" : "try_lock", x.address);
  line["level"] = static_cast<int>(x.level);
  return {.numbers = {write_begin(line)}};
}

OperationRecorder::Open OperationRecorder::begin(const UnlockRequest& x) {
  auto line = begin_line("unlock", x.address);
  line["token"] = x.token;
  return {.numbers = {write_begin(line)}};
}

OperationRecorder::Open OperationRecorder::begin(const ExistsQuery& x) {
  return {.numbers = {write_begin(begin_line("exists", x.address))}};
}

OperationRecorder::Open OperationRecorder::begin(const VersionQuery& x) {
  return {.numbers = {write_begin(begin_line("version", x.address))}};
}

template <class T, class F>
void OperationRecorder::end_all(std::uint64_t id, const Outcome<T>& outcome, F&& describe) {
  auto open = open_.extract(id);
  if (!open)
    return;
  auto now = nanoseconds(Clock::now());
  for (std::size_t i = 0; i < open.mapped().numbers.size(); ++i) {
    Line line;
    line["end"] = open.mapped().numbers[i];
    line["at"] = now;
    if (outcome) {
      describe(line, i);
    } else {
      auto& where = open.mapped().where;
      line["failure"] = static_cast<int>(outcome.failure().kind);
      if (!where.empty() && where[i] != outcome.failure().address)
        line["another"] = true;
    }
    write(line);
  }
}

void OperationRecorder::end(std::uint64_t id, const Outcome<Version>& x) {
  end_all(id, x, [&](Line& line, std::size_t) { line["version"] = *x; });
}

void OperationRecorder::end(std::uint64_t id, const Outcome<std::vector<Version>>& x) {
  end_all(id, x, [&](Line& line, std::size_t i) { line["version"] = x->at(i); });
}

void OperationRecorder::end(std::uint64_t id, const Outcome<EntryPtr>& x) {
  end_all(id, x, [&](Line& line, std::size_t) {
    line["version"] = (*x)->version;
    line["content"] = hash((*x)->value);
  });
}

void OperationRecorder::end(std::uint64_t id, const Outcome<std::vector<EntryPtr>>& x) {
  auto open = open_.find(id);
  if (open == open_.end())
    return;
  for (auto i = std::size_t{0}; x && i < x->size(); ++i)
    open->second.numbers.push_back(
      write_begin(begin_line("read", x->at(i)->address, open->second.since)));
  end_all(id, x, [&](Line& line, std::size_t i) {
    line["version"] = x->at(i)->version;
    line["content"] = hash(x->at(i)->value);
  });
}

void OperationRecorder::read_here(const EntryPtr& entry, Clock::time_point since) {
  // No request has that id.
  constexpr std::uint64_t id = 0;
  sent(id, {since, {write_begin(begin_line("read", entry->address, since))}});
  end(id, Outcome<EntryPtr>{entry});
}

void OperationRecorder::end(std::uint64_t id, const Outcome<bool>& x) {
  end_all(id, x, [&](Line& line, std::size_t) { line["exists"] = *x; });
}

void OperationRecorder::end(std::uint64_t id, const Outcome<Lease>& x) {
  end_all(id, x, [&](Line& line, std::size_t) { line["token"] = x->token; });
}

void OperationRecorder::end(std::uint64_t id, const Outcome<Acknowledged>& x) {
  end_all(id, x, [](Line&, std::size_t) {});
}

} // namespace castor
