#include "castor/tools/cli/workload_run.hpp"

#include "castor/base/log.hpp"
#include "castor/tools/cli/output.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;

/// How often it is tried again what cannot be done now.
constexpr auto time_between_tries = 100ms;

/// How long the thread sleeps at most that does what is due.
constexpr auto longest_sleep = 1s;

/// How long what was begun may take once nothing new is.
constexpr auto longest_finish = 20s;

/// Entry types by which people talk to the robot (communication/types.hpp).
constexpr const char* heard_type = "PhonString";
constexpr const char* said_type = "SpokenOutputItem";
/// What the robot says in reply to what it has not understood.
constexpr const char* apology = "clarification_question";

/// Whoever listens is to stop.
struct Over {};

std::size_t count_words(const std::string& sentence) {
  std::istringstream in{sentence};
  std::size_t result = 0;
  for (std::string word; in >> word;)
    ++result;
  return result;
}

/// A new file takes the place of the old one, so that nobody reads half of it.
void replace_file(const std::filesystem::path& file, const std::string& text) {
  auto part = file;
  part += ".new";
  {
    auto out = create(part);
    out << text;
    out.flush();
    if (!out)
      throw std::runtime_error("cannot write " + part.string());
  }
  std::filesystem::rename(part, file);
}

} // namespace

WorkloadRun::WorkloadRun(const CheckedWorkload& workload, std::uint64_t seed, Timestamp duration)
  : workload_(workload), system_{"the system", folder_.path() / "system.sock"},
    scene_file_(folder_.path() / workload.scene_file.filename()),
    schedule_(faults::schedule_of(workload.workload, seed, duration)), scene_(workload.scene) {
  for (auto& x : workload.workload.statements)
    statements_.push_back({faults::to_string(x), {}, {}});
}

WorkloadRun::~WorkloadRun() {
  is_over_ = true;
  changed_.notify_all();
  for (auto& x : threads_)
    x.join();
}

void WorkloadRun::prepare(ArchitectureDescription& architecture) {
  auto changes = [](auto& x) { return std::ranges::any_of(x.actions, faults::changes_scene); };
  if (!scene_ || std::ranges::none_of(workload_.workload.statements, changes))
    return;
  replace_file(scene_file_, scene_->text());
  auto sees_it = [&](auto& x) {
    return std::ranges::find(workload_.places.cameras, x.name,
                             &faults::WorkloadPlaces::Camera::component) !=
           workload_.places.cameras.end();
  };
  for_each_component(architecture, [&](ComponentDescription& x) {
    if (!sees_it(x))
      return;
    for (auto& option : x.options)
      if (option.name() == "source")
        option.value = "scene:" + scene_file_.string();
  });
}

void WorkloadRun::watch(SystemOptions& options) {
  options.endpoint = system_.socket;
  if (workload_.places.listening.empty())
    return;
  options.on_up = [this, memory = working_memory_of(workload_.places.listening),
                   next = std::move(options.on_up)](const ComponentUp& x) {
    if (next)
      next(x);
    if (x.component != memory)
      return;
    std::lock_guard guard{mutex_};
    memory_was_lost_ = true;
    changed_.notify_all();
  };
}

void WorkloadRun::begin() {
  begin_ = Clock::now();
  threads_.emplace_back([this] { act(); });
  if (!workload_.places.listening.empty())
    threads_.emplace_back([this] { listen(); });
}

void WorkloadRun::finish_actions() {
  std::unique_lock guard{mutex_};
  is_finishing_ = true;
  took_ = now();
  changed_.notify_all();
  changed_.wait_for(guard, longest_finish, [&] { return tasks_.empty(); });
}

faults::WorkloadRecord WorkloadRun::end() {
  is_over_ = true;
  changed_.notify_all();
  for (auto& x : threads_)
    x.join();
  threads_.clear();
  if (!workload_.places.listening.empty())
    try {
      // Answers of which nobody was told: given while the listeners came back.
      for (auto& x : ask_for_all(system_, {{"do", "wm"},
                                           {"subarchitecture", workload_.places.listening},
                                           {"what", said_type},
                                           {"values", true}}))
        hear(x, std::nullopt);
    } catch (const std::exception& e) {
      log_runtime(LogLevel::warning, "workload", e.what());
    }
  faults::WorkloadRecord result;
  result.file = workload_.workload.file;
  result.took = took_;
  result.statements = statements_;
  count_sentences(result, sentences_.all(), workload_.workload.answer_within);
  return result;
}

// -- what is done

void WorkloadRun::act() {
  std::unique_lock guard{mutex_};
  while (!is_over_) {
    take_due();
    say_again();
    if (!tasks_.empty()) {
      guard.unlock();
      try_tasks();
      guard.lock();
    }
    auto wake = now() + longest_sleep;
    if (!tasks_.empty())
      wake = now() + time_between_tries;
    if (!is_finishing_ && next_ < schedule_.size())
      wake = std::min<Timestamp>(wake, schedule_[next_].at);
    changed_.wait_until(guard, begin_ + wake);
  }
}

void WorkloadRun::take_due() {
  for (; !is_finishing_ && next_ < schedule_.size() && schedule_[next_].at <= now(); ++next_) {
    auto& x = schedule_[next_];
    auto number = ++statements_[x.statement].counts.due;
    if (auto* sentence = std::get_if<faults::Say>(&x.action))
      number = sentences_.add(sentence->sentence, x.statement);
    tasks_.push_back({x.action, x.statement, number});
  }
}

void WorkloadRun::say_again() {
  if (!std::exchange(memory_was_lost_, false))
    return;
  for (auto place : sentences_.unanswered()) {
    auto& x = sentences_.all()[place];
    tasks_.push_back({faults::Say{x.text}, x.statement, place, true, true});
  }
}

void WorkloadRun::try_tasks() {
  std::deque<Task> tasks;
  {
    std::lock_guard guard{mutex_};
    tasks = tasks_;
  }
  std::deque<Task> left;
  // What is for one working memory stays in its order.
  std::set<std::string> failing;
  for (auto& task : tasks) {
    std::string where;
    if (std::holds_alternative<faults::Say>(task.action))
      where = workload_.places.listening;
    else if (auto* x = std::get_if<faults::WriteEntry>(&task.action))
      where = x->subarchitecture;
    std::string problem = is_over_ ? "there was no time left" : std::string{};
    if (problem.empty() && !failing.contains(where))
      try {
        carry_out(task);
        std::lock_guard guard{mutex_};
        if (!task.again)
          ++statements_[task.statement].counts.done;
        continue;
      } catch (const std::exception& e) {
        problem = e.what();
      }
    failing.insert(where);
    std::lock_guard guard{mutex_};
    if (!problem.empty())
      statements_[task.statement].problem = problem;
    left.push_back(task);
    left.back().was_tried = true;
  }
  std::lock_guard guard{mutex_};
  tasks_.erase(tasks_.begin(), tasks_.begin() + static_cast<std::ptrdiff_t>(tasks.size()));
  tasks_.insert(tasks_.begin(), left.begin(), left.end());
  changed_.notify_all();
}

void WorkloadRun::carry_out(const Task& task) {
  if (auto* sentence = std::get_if<faults::Say>(&task.action))
    say(*sentence, task);
  else if (auto* entry = std::get_if<faults::WriteEntry>(&task.action))
    write(*entry, task);
  else
    change_scene(task.action);
}

void WorkloadRun::say(const faults::Say& x, const Task& task) {
  auto& where = workload_.places.listening;
  std::string id;
  {
    std::lock_guard guard{mutex_};
    id = sentences_.all()[task.number].id;
  }
  bool is_there = task.was_tried && exists(where, id);
  if (!is_there)
    ask_for_one(system_, {{"do", "write"},
                          {"subarchitecture", where},
                          {"id", id},
                          {"type", heard_type},
                          {"value",
                           {{"word_sequence", x.sentence},
                            {"length", count_words(x.sentence)},
                            {"confidence", 1.0},
                            {"rank", 0},
                            {"turn", task.number}}}});
  std::lock_guard guard{mutex_};
  if (!is_there || !task.again)
    sentences_.said(task.number, now());
}

void WorkloadRun::write(const faults::WriteEntry& x, const Task& task) {
  Json request{{"do", "write"},
               {"subarchitecture", x.subarchitecture},
               {"id", x.id},
               {"type", x.type},
               {"value", Json::parse(x.value)}};
  if (x.id.empty()) {
    request["id"] =
      "workload:" + std::to_string(task.statement + 1) + ":" + std::to_string(task.number);
    if (task.was_tried && exists(x.subarchitecture, request["id"]))
      return;
  } else if (exists(x.subarchitecture, x.id)) {
    request["do"] = "overwrite";
  }
  ask_for_one(system_, request);
}

void WorkloadRun::change_scene(const faults::Action& x) {
  if (auto* move = std::get_if<faults::MoveThing>(&x))
    scene_->move(move->thing, move->x, move->y);
  else if (auto* add = std::get_if<faults::AddThing>(&x))
    scene_->add(add->thing, add->place);
  else if (auto* remove = std::get_if<faults::RemoveThing>(&x))
    scene_->remove(remove->thing);
  replace_file(scene_file_, scene_->text());
}

bool WorkloadRun::exists(const std::string& subarchitecture, const std::string& id) const {
  try {
    return !ask_for_all(system_, {{"do", "wm"}, {"subarchitecture", subarchitecture}, {"what", id}})
              .empty();
  } catch (const std::runtime_error&) {
    // Neither an entry nor a type is called so, or nobody answers, which writing will show.
    return false;
  }
}

// -- what comes of it

void WorkloadRun::listen() {
  const Json request{
    {"do", "events"},
    {"filter", std::string{"added "} + said_type + " in " + workload_.places.listening},
    {"values", true},
    {"wait", true}};
  auto until_over = [this]() -> std::vector<Json> {
    if (is_over_)
      throw Over{};
    return {};
  };
  while (!is_over_)
    try {
      ask(
        system_, request, [this](const Json& x) { hear(x, now()); }, until_over);
    } catch (const Over&) {
      return;
    } catch (const std::exception& e) {
      log_runtime(LogLevel::debug, "workload", e.what());
      std::unique_lock guard{mutex_};
      changed_.wait_for(guard, time_between_tries, [this] { return is_over_.load(); });
    }
}

void WorkloadRun::hear(const Json& output, std::optional<Timestamp> at) {
  if (!output.contains("value"))
    return;
  auto& value = output["value"];
  std::lock_guard guard{mutex_};
  auto utterance = value.value(Json::json_pointer{"/utterance/address/id"}, "");
  sentences_.answer(utterance, value.value("relation", "") == apology, at);
}

} // namespace castor::cli
