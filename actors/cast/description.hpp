#pragma once

#include "castor/actors/cast/supervision_policy.hpp"
#include "castor/actors/component/component_kind.hpp"
#include "castor/base/source_location.hpp"
#include "castor/wm/entries/working_memory_name.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// One option of a component line, such as `--min-area 40`.
struct OptionSetting {
  /// As the user wrote it, dashes included.
  std::string key;
  /// "true" for a key without a value; quotes removed.
  std::string value;
  SourceLocation where;

  /// The key without its leading dashes.
  std::string_view name() const noexcept;
};

enum class Language { cpp, java, python };

/// The words used in JSON and in messages, e.g. "working memory", "C++".
std::string_view to_string(ComponentKind kind) noexcept;
std::string_view to_string(Language language) noexcept;

/// Everything a `.cast` file says about one component.
struct ComponentDescription {
  ComponentKind kind = ComponentKind::managed;
  /// Unique in the architecture; `<subarchitecture>_wm` and `<subarchitecture>_tm` for the two that
  /// the language leaves without a name.
  std::string name;
  std::string class_name;
  Language language = Language::cpp;
  /// After replacement of `[Name]` and of localhost.
  std::string host;
  /// In the order of first appearance; a repeated key holds its last value.
  std::vector<OptionSetting> options;
  /// Counts component lines from 0: those of subarchitectures in file order, then stand-alone ones.
  std::size_t number = 0;
  /// Empty for a stand-alone component.
  std::string subarchitecture;
  SourceLocation where;
  /// Its line as written.
  std::string line;

  /// @param key_or_name with or without dashes
  /// @returns null if the option is not set
  const OptionSetting* option(std::string_view key_or_name) const noexcept;

  /// Whether an option that is either on or off is on.
  bool is_on(std::string_view key_or_name) const noexcept;
};

struct SubarchitectureDescription {
  std::string name;
  /// Default host of its component lines.
  std::string host;
  ComponentDescription working_memory;
  ComponentDescription task_manager;
  /// Managed and unmanaged, in file order.
  std::vector<ComponentDescription> components;
  SourceLocation where;

  /// Finds by name, working memory and task manager included.
  const ComponentDescription* component(std::string_view wanted) const noexcept;
};

/// Allows components of one subarchitecture to write to the working memory of another.
struct AccessRule {
  /// Owner of a rule by which operators may write nowhere.
  static constexpr std::string_view nothing = "nothing";

  /// A subarchitecture, "*" for all, or `operators`, who may write everywhere if no rule is about
  /// them.
  std::string writer;
  std::string owner;
  SourceLocation where;
};

/// Allows components of one subarchitecture to read the working memory of another. If a rule names
/// an owner, others may not.
struct ReadRule {
  /// A subarchitecture, or "*" for all.
  std::string reader;
  /// A subarchitecture.
  std::string owner;
  SourceLocation where;
};

/// Supervision policy of a subarchitecture.
struct SupervisionRule {
  /// Stands for the level above the subarchitectures.
  static constexpr std::string_view system = "SYSTEM";

  /// A subarchitecture, "*" for all that no other rule names, or `system`.
  std::string who;
  SupervisionPolicy policy;
  SourceLocation where;
};

/// Hosts on which a subarchitecture or component is started again when its node is lost.
struct FailoverRule {
  /// A subarchitecture or a component.
  std::string who;
  /// In order of preference: the first in reach is taken.
  std::vector<std::string> hosts;
  SourceLocation where;
};

/// A whole system, as a `.cast` file describes it. Pure data: nothing has been looked up outside of
/// the file.
struct ArchitectureDescription {
  /// The main file as it was named to the parser.
  std::string file;
  /// Value of CONFIG_DIR: the main file's directory, relative to the working directory if below it.
  std::string config_dir;
  std::vector<SubarchitectureDescription> subarchitectures;
  std::vector<ComponentDescription> standalone;
  /// Names given by HOSTNAME lines, and what they stand for.
  std::map<std::string, std::string> host_names;
  std::vector<AccessRule> access_rules;
  std::vector<ReadRule> read_rules;
  std::vector<SupervisionRule> supervision;
  std::vector<FailoverRule> failover;
  /// Components of the file that this run leaves out; options may still name them.
  std::set<std::string, std::less<>> left_out;

  /// All look-ups return null if there is no such name.
  const SubarchitectureDescription* subarchitecture(std::string_view name) const noexcept;
  const ComponentDescription* component(std::string_view name) const noexcept;

  /// Whether components of `writer` may write to the working memory of `owner`: at home always,
  /// elsewhere if an access rule says so.
  bool may_write(std::string_view writer, std::string_view owner) const noexcept;

  /// Subarchitectures whose components may read the working memory of `owner`, besides its own, "*"
  /// for all; nothing if no rule names it, and everybody may.
  std::optional<std::set<std::string>> readers(std::string_view owner) const;

  bool may_read(std::string_view reader, std::string_view owner) const;

  /// Policy of a subarchitecture, or of SupervisionRule::system.
  SupervisionPolicy supervision_of(std::string_view who) const noexcept;

  /// Hosts to which a component may move; empty if none.
  std::vector<std::string> failover_of(const ComponentDescription& component) const;
};

/// Calls `f` with every component line, working memories and task managers included, in the order
/// of the file. The architecture may be constant or not.
template <class Architecture, class F>
void for_each_component(Architecture& architecture, F&& f) {
  for (auto& subarchitecture : architecture.subarchitectures) {
    f(subarchitecture.working_memory);
    f(subarchitecture.task_manager);
    for (auto& x : subarchitecture.components)
      f(x);
  }
  for (auto& x : architecture.standalone)
    f(x);
}

} // namespace castor
