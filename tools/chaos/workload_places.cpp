#include "castor/tools/chaos/workload_places.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/entries/client.hpp"

#include <algorithm>
#include <set>

namespace castor::faults {

namespace {

constexpr std::string_view scene_prefix = "scene:";

/// How many names are listed where none of them was meant.
constexpr std::size_t most_listed_places = 20;

/// The file of a source that is a scene.
std::optional<std::string> scene_of(const ComponentDescription& x) {
  auto* source = x.option("source");
  if (x.class_name != "Camera" || !source)
    return std::nullopt;
  if (source->value.starts_with(scene_prefix))
    return source->value.substr(scene_prefix.size());
  return source->value.ends_with(".scene") ? std::optional{source->value} : std::nullopt;
}

/// Looks at one workload.
class WorkloadCheck {
public:
  WorkloadCheck(const Workload& workload, const WorkloadPlaces& places,
                const std::optional<SceneText>& scene,
                const std::function<std::string(const WriteEntry&)>& problem_of,
                const std::function<bool(const std::string&)>& is_type)
    : workload_(workload), places_(places), scene_(scene), problem_of_(problem_of),
      is_type_(is_type) {
    if (scene)
      for (auto& x : scene->things())
        things_.insert(x);
    for (auto& statement : workload.statements)
      for (auto& action : statement.actions)
        if (auto* x = std::get_if<AddThing>(&action))
          things_.insert(lower_case(x->thing));
  }

  std::vector<Diagnostic> run() {
    bool speaks = false;
    for (auto& statement : workload_.statements) {
      where_ = statement.where;
      line_ = statement.line;
      for (auto& action : statement.actions) {
        speaks = speaks || std::holds_alternative<Say>(action);
        std::visit([this](auto& x) { look(x); }, action);
      }
    }
    where_ = {};
    line_.clear();
    if (workload_.answer_within && !speaks)
      report("answers are expected, but no sentence is said",
             R"(add a line such as every 4s say "Where is the ball?")");
    if (workload_.same)
      look(*workload_.same);
    for (auto& x : workload_.never)
      look(x.filter, x.where, x.line);
    for (auto& x : workload_.each)
      for (auto* filter : {&x.begin, &x.end})
        look(*filter, x.where, x.line);
    return std::move(out_);
  }

private:
  void look(const Say&) {
    if (places_.listening.empty())
      report("no subarchitecture has an UtteranceParser to listen",
             "remove the sentences, or add the communication subarchitecture of "
             "configs/playmate.cast");
  }

  void look(const WriteEntry& x) {
    if (!has(places_.subarchitectures, x.subarchitecture))
      return unknown("subarchitecture", x.subarchitecture, places_.subarchitectures);
    if (has(places_.closed, x.subarchitecture))
      return report("operators may not write to " + in_quotes(x.subarchitecture),
                    "add the line ACCESS operator WRITES " + x.subarchitecture +
                      " to the .cast file");
    if (auto problem = problem_of_(x); !problem.empty())
      report(std::move(problem), "`castor wm types TYPE` prints an example of a value");
  }

  void look(const MoveThing& x) { thing(x.thing); }
  void look(const AddThing&) { needs_scene(); }
  void look(const RemoveThing& x) { thing(x.thing); }

  void look(const SameEntries& x) {
    where_ = x.where;
    line_ = x.line;
    for (auto& type : x.types)
      if (!is_type_(type))
        report("there is no entry type " + in_quotes(type), "`castor wm types` lists them");
  }

  void look(const ChangeFilter& filter, const SourceLocation& where, const std::string& line) {
    where_ = where;
    line_ = line;
    if (!filter.type.empty() && !is_type_(filter.type))
      report("there is no entry type " + in_quotes(filter.type), "`castor wm types` lists them");
    auto& subarchitecture = filter.subarchitecture;
    if (subarchitecture && !subarchitecture->empty() &&
        !has(places_.subarchitectures, *subarchitecture))
      unknown("subarchitecture", *subarchitecture, places_.subarchitectures);
  }

  bool needs_scene() {
    if (!scene_)
      report("no camera sees a scene that could be changed",
             "give one Camera a --source scene:FILE");
    return scene_.has_value();
  }

  void thing(const std::string& name) {
    if (!needs_scene() || things_.contains(lower_case(name)) || scene_->has(name))
      return;
    unknown("thing on the table", name, {things_.begin(), things_.end()});
  }

  static bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  }

  void unknown(std::string_view what, const std::string& name,
               const std::vector<std::string>& names) {
    auto remedy = out_.size() < most_explained ? did_you_mean(name, {names.begin(), names.end()})
                                               : std::string{};
    if (remedy.empty() && !names.empty())
      remedy = "there are: " + list_of(names, most_listed_places);
    report("there is no " + std::string{what} + " " + in_quotes(name), std::move(remedy));
  }

  void report(std::string message, std::string remedy) {
    out_.push_back({Severity::error, where_, line_, {}, std::move(message), std::move(remedy)});
  }

  const Workload& workload_;
  const WorkloadPlaces& places_;
  const std::optional<SceneText>& scene_;
  const std::function<std::string(const WriteEntry&)>& problem_of_;
  const std::function<bool(const std::string&)>& is_type_;
  std::set<std::string> things_;
  SourceLocation where_;
  std::string line_;
  std::vector<Diagnostic> out_;
};

} // namespace

WorkloadPlaces places_of(const ArchitectureDescription& architecture) {
  WorkloadPlaces result;
  for (auto& x : architecture.subarchitectures) {
    result.subarchitectures.push_back(x.name);
    if (!architecture.may_write(operators, x.name))
      result.closed.push_back(x.name);
    if (std::ranges::any_of(x.components,
                            [](auto& y) { return y.class_name == "UtteranceParser"; }))
      result.listening = x.name;
  }
  for_each_component(architecture, [&](const ComponentDescription& x) {
    if (auto file = scene_of(x)) {
      auto* base = x.option("base");
      result.cameras.push_back({x.name, *file, base ? base->value : std::string{}});
    }
  });
  return result;
}

std::vector<Diagnostic>
check_workload(const Workload& workload, const WorkloadPlaces& places,
               const std::optional<SceneText>& scene,
               const std::function<std::string(const WriteEntry&)>& problem_of,
               const std::function<bool(const std::string& type)>& is_type) {
  return WorkloadCheck{workload, places, scene, problem_of, is_type}.run();
}

} // namespace castor::faults
