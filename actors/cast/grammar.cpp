#include "castor/actors/cast/grammar.hpp"

#include "castor/actors/cast/access_rule_parser.hpp"
#include "castor/actors/cast/component_line.hpp"
#include "castor/actors/cast/keywords.hpp"
#include "castor/actors/cast/supervision_rules.hpp"
#include "castor/actors/cast/words.hpp"
#include "castor/actors/component/health.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/entries/client.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace castor::cast {

namespace {

class StatementReader {
public:
  StatementReader(Preprocessed& input, const ParseOptions& options, DiagnosticLog& log)
    : input_(input), options_(options), log_(log) {
    // nop
  }

  Structure run() {
    for (const auto& line : input_.lines)
      process(line);
    end_section(nullptr);
    read_standalone_components();
    check_reserved_names();
    auto names = subarchitecture_names();
    access_rule_parser_.finish(names, !options_.running_subarchitectures.empty(), result_, log_);
    supervision_rules_.finish(names, result_, log_);
    result_.host_names = input_.hosts.definitions();
    for (auto& x : dropped_)
      result_.subarchitectures.push_back(std::move(x));
    return {std::move(result_), std::move(doubtful_)};
  }

private:
  /// The lines between SUBARCHITECTURE or ARCHITECTURE and the next section line.
  struct Section {
    const StructureLine* line = nullptr;
    /// Absent for ARCHITECTURE.
    std::optional<SubarchitectureDescription> subarchitecture;
    /// It has no name, or that of another one: its lines are checked only.
    bool is_broken = false;
    const SourceLine* working_memory = nullptr;
    const SourceLine* task_manager = nullptr;
  };

  struct StandaloneLine {
    const StructureLine* line = nullptr;
    /// The default host at this place of the file.
    std::string host_here;
  };

  void process(const StructureLine& line) {
    auto keyword = match_section_keyword(line.text);
    if (keyword && keyword->glued)
      remark_on_glued(*keyword, line);
    auto is_component = looks_like_component(line.text) && !is_misspelt_component(line);
    if (keyword)
      begin(keyword->keyword, line);
    else if (auto intended = is_component ? std::string_view{} : misspelt_keyword(line);
             !intended.empty())
      recover(intended, line);
    else if (is_component || section_)
      component_line(line);
    else {
      doubt(line);
      report(Severity::error, line, in_quotes(first_word(line)) + " is not a keyword",
             "write SUBARCHITECTURE, HOST, COMPONENT, ACCESS, SUPERVISE, FAILOVER or INCLUDE, or # "
             "before "
             "a comment");
    }
  }

  /// The line was not understood: what it names may exist.
  void doubt(const StructureLine& line) {
    auto rest = line.text;
    for (auto word = take_word(rest); !word.empty(); word = take_word(rest))
      if (doubtful_.size() < most_candidates)
        doubtful_.emplace(word);
  }

  static std::string_view first_word(const StructureLine& line) noexcept {
    auto rest = line.text;
    return take_word(rest);
  }

  void begin(SectionKeyword keyword, const StructureLine& line) {
    end_section(&line);
    WordStream words(line, options_.environment, log_);
    words.next();
    switch (keyword) {
      case SectionKeyword::subarchitecture:
        begin_subarchitecture(line, words);
        return;
      case SectionKeyword::architecture:
        section_ = Section{&line, std::nullopt, false, nullptr, nullptr};
        report(Severity::warning, line, "ARCHITECTURE has no effect", "remove the line");
        return;
      case SectionKeyword::host:
        host(line, words);
        return;
      case SectionKeyword::connection:
        report(Severity::warning, line, "CONNECTION has no effect",
               "remove the line; stand-alone components find each other by name");
        return;
      case SectionKeyword::component:
        standalone_lines_.push_back({&line, default_host_});
        return;
      case SectionKeyword::access:
        access_rule_parser_.read(words, line, log_);
        return;
      case SectionKeyword::supervise:
        supervision_rules_.read_supervise(words, line, log_);
        return;
      case SectionKeyword::failover:
        supervision_rules_.read_failover(words, line, log_,
                                         [&](auto host) { return used_host(host, line); });
        return;
    }
  }

  void remark_on_glued(const KeywordMatch<SectionKeyword>& keyword, const StructureLine& line) {
    auto word = first_word(line);
    auto intended = misspelt_keyword(line);
    report(Severity::warning, line, in_quotes(word) + " is read as " + std::string(keyword.word),
           intended.empty() || intended == keyword.word
             ? "put a blank behind " + std::string(keyword.word)
             : "did you mean " + in_quotes(intended) + "?");
  }

  /// `COMPONET CPP name Class` looks like a line with a host, but has no kind.
  bool is_misspelt_component(const StructureLine& line) const {
    auto rest = line.text;
    auto first = take_word(rest);
    return match_language(take_word(rest)) && !match_kind(take_word(rest)) &&
           !match_language(first) && nearest(first, {"COMPONENT"}) == "COMPONENT";
  }

  std::string_view misspelt_keyword(const StructureLine& line) const {
    if (!log_.has_room(Severity::error))
      return {};
    return nearest(first_word(line), all_line_keywords());
  }

  /// Goes on as if the misspelt section keyword were right, so that what follows it is not reported
  /// as well.
  void recover(std::string_view keyword, const StructureLine& line) {
    if (keyword == first_word(line)) {
      doubt(line);
      report(Severity::error, line,
             in_quotes(keyword) + " came out of a variable, where it has no effect",
             "write the keyword itself");
      return;
    }
    report(Severity::error, line, in_quotes(first_word(line)) + " is not a keyword",
           "did you mean " + in_quotes(keyword) + "?");
    if (auto match = match_section_keyword(keyword))
      begin(match->keyword, line);
    else
      doubt(line);
  }

  void host(const StructureLine& line, WordStream& words) {
    auto word = words.next();
    if (!is_given(word)) {
      report(Severity::error, line, "HOST without a host", "write HOST localhost");
      return;
    }
    if (match_language(*word)) {
      report(Severity::error, line, in_quotes(first_word(line)) + " is read as HOST",
             "the name of a host cannot begin like a keyword: write HOSTNAME Name address above "
             "and [Name] here");
      return;
    }
    default_host_ = used_host(*word, line);
    words.warn_of_rest();
  }

  void begin_subarchitecture(const StructureLine& line, WordStream& words) {
    section_ = Section{&line, SubarchitectureDescription{}, false, nullptr, nullptr};
    auto& subarchitecture = *section_->subarchitecture;
    subarchitecture.where = line.line->where();
    auto name = words.next();
    if (!is_given(name)) {
      report(Severity::error, line, "SUBARCHITECTURE without a name",
             "write SUBARCHITECTURE name or SUBARCHITECTURE name host");
      section_->is_broken = true;
    } else if (*name == health_subarchitecture) {
      report(Severity::error, line,
             in_quotes(*name) +
               " is the subarchitecture of the health entries that every system has",
             "give the subarchitecture another name");
      section_->is_broken = true;
    } else if (*name == operators || *name == AccessRule::nothing) {
      report(Severity::error, line, in_quotes(*name) + " is a keyword of ACCESS lines",
             "give the subarchitecture another name");
      section_->is_broken = true;
    } else if (auto [first, is_new] = subarchitecture_lines_.try_emplace(*name, line.line);
               !is_new) {
      report(Severity::error, line,
             "there is a subarchitecture " + in_quotes(*name) + " already, at " +
               to_string(first->second->where()),
             "give one of them another name");
      section_->is_broken = true;
    }
    subarchitecture.name = name.value_or("");
    subarchitecture.host = subarchitecture_host(line, words);
  }

  std::string subarchitecture_host(const StructureLine& line, WordStream& words) {
    auto word = words.next();
    if (is_given(word)) {
      words.warn_of_rest();
      return used_host(*word, line);
    }
    return default_host(line);
  }

  /// That of the last HOST line; systems that name no host run where they are started.
  std::string default_host(const StructureLine& line) {
    return default_host_.empty() ? used_host("localhost", line) : default_host_;
  }

  void component_line(const StructureLine& line) {
    if (!section_) {
      outside(line);
      return;
    }
    if (!section_->subarchitecture) {
      doubt(line);
      report(Severity::error, line, "there are no component lines in an ARCHITECTURE section",
             "write COMPONENT before the line, or SUBARCHITECTURE name above");
      return;
    }
    auto& subarchitecture = *section_->subarchitecture;
    // A name that is missing has been reported; stand-alone components are those without one.
    std::string_view name = subarchitecture.name;
    if (name.empty())
      name = "?";
    WordStream words(line, options_.environment, log_);
    auto parsed =
      parse_component_line(words, line, {name, subarchitecture.host}, input_.hosts, log_);
    if (parsed.kind == ComponentKind::working_memory)
      replace(section_->working_memory, "WM", line);
    else if (parsed.kind == ComponentKind::task_manager)
      replace(section_->task_manager, "TM", line);
    if (!parsed.component) {
      doubt(line);
      return;
    }
    parsed.component->number = next_number_++;
    switch (parsed.component->kind) {
      case ComponentKind::working_memory:
        subarchitecture.working_memory = std::move(*parsed.component);
        return;
      case ComponentKind::task_manager:
        subarchitecture.task_manager = std::move(*parsed.component);
        return;
      default:
        check_unique(parsed.component->name, line);
        subarchitecture.components.push_back(std::move(*parsed.component));
    }
  }

  void replace(const SourceLine*& last, const std::string& kind, const StructureLine& line) {
    if (last != nullptr)
      report(Severity::warning, line,
             "second " + kind + " line of this subarchitecture: it replaces the one at " +
               to_string(last->where()),
             "remove one of them");
    last = line.line;
  }

  void outside(const StructureLine& line) {
    check_outside(line);
    if (section_end_ == nullptr)
      report(Severity::error, line, "this component line is outside of any subarchitecture",
             "write SUBARCHITECTURE name above it, or COMPONENT before it");
    else
      report(Severity::error, line,
             "this component line is outside of any subarchitecture: the last section ended at " +
               to_string(section_end_->line->where()) + " with " +
               in_quotes(first_word(*section_end_)),
             "move it up to the other lines of its subarchitecture");
  }

  /// Reads a component line that belongs to no subarchitecture, for what else may be wrong with it.
  void check_outside(const StructureLine& line) {
    WordStream words(line, options_.environment, log_);
    auto parsed = parse_component_line(words, line, {"?", default_host(line)}, input_.hosts, log_);
    if (!parsed.component) {
      doubt(line);
      return;
    }
    auto& place = dropped_.emplace_back();
    if (parsed.component->kind == ComponentKind::working_memory)
      place.working_memory = std::move(*parsed.component);
    else if (parsed.component->kind == ComponentKind::task_manager)
      place.task_manager = std::move(*parsed.component);
    else
      place.components.push_back(std::move(*parsed.component));
  }

  void check_unique(const std::string& name, const StructureLine& line) {
    auto [first, is_new] = component_lines_.try_emplace(name, &line);
    if (!is_new)
      report(Severity::error, line,
             "there is a component " + in_quotes(name) + " already, at " +
               to_string(first->second->line->where()),
             "give one of them another name; names are unique in the whole architecture");
  }

  void end_section(const StructureLine* end) {
    if (!section_)
      return;
    auto section = std::exchange(section_, std::nullopt);
    section_end_ = end;
    if (!section->subarchitecture)
      return;
    if (section->is_broken) {
      dropped_.push_back(std::move(*section->subarchitecture));
      return;
    }
    const auto& name = section->subarchitecture->name;
    if (options_.running_subarchitectures.count(name) > 0) {
      result_.subarchitectures.push_back(std::move(*section->subarchitecture));
      return;
    }
    if (section->working_memory == nullptr)
      report(Severity::error, *section->line,
             "subarchitecture " + in_quotes(name) + " has no working memory",
             "add the line: CPP WM SubarchitectureWorkingMemory");
    if (section->task_manager == nullptr)
      report(Severity::error, *section->line,
             "subarchitecture " + in_quotes(name) + " has no task manager",
             "add the line: CPP TM AlwaysPositiveTaskManager");
    result_.subarchitectures.push_back(std::move(*section->subarchitecture));
  }

  /// Stand-alone components come after all others, and see the last default host of the file.
  void read_standalone_components() {
    for (const auto& [line, host_here] : standalone_lines_) {
      WordStream words(*line, options_.environment, log_);
      words.next();
      auto has_own_host = !match_language(words.peek());
      auto parsed =
        parse_component_line(words, *line, {{}, default_host(*line)}, input_.hosts, log_);
      if (!parsed.component) {
        doubt(*line);
        continue;
      }
      if (!has_own_host && host_here != default_host_)
        report(Severity::warning, *line,
               "this component's host is " + in_quotes(default_host_) +
                 ", that of the last HOST line of the file",
               "write the host before the language");
      check_unique(parsed.component->name, *line);
      parsed.component->number = next_number_++;
      result_.standalone.push_back(std::move(*parsed.component));
    }
  }

  void check_reserved_names() {
    if (auto found = component_lines_.find(working_memory_of(health_subarchitecture));
        found != component_lines_.end())
      report(Severity::error, *found->second,
             in_quotes(found->first) + " is the name of a working memory that every system has",
             "give the component another name");
    for (const auto& subarchitecture : result_.subarchitectures)
      for (auto suffix : {"_wm", "_tm"}) {
        auto id = subarchitecture.name + suffix;
        if (auto found = component_lines_.find(id); found != component_lines_.end())
          report(Severity::error, *found->second,
                 in_quotes(id) + " is the name of the " +
                   (suffix[1] == 'w' ? "working memory" : "task manager") + " of " +
                   in_quotes(subarchitecture.name),
                 "give the component another name");
      }
  }

  /// Those with errors in their sections, too.
  std::set<std::string, std::less<>> subarchitecture_names() const {
    auto names = options_.running_subarchitectures;
    for (const auto& [name, line] : subarchitecture_lines_)
      names.insert(name);
    return names;
  }

  std::string used_host(std::string_view expression, const StructureLine& line) {
    return use_host(expression, line, input_.hosts, log_);
  }

  void report(Severity severity, const StructureLine& line, std::string message,
              std::string remedy) {
    log_.report(severity, *line.line, std::move(message), std::move(remedy), line.text);
  }

  Preprocessed& input_;
  const ParseOptions& options_;
  DiagnosticLog& log_;
  ArchitectureDescription result_;
  /// With errors of their own, or of their places: of no use but to be checked further.
  std::vector<SubarchitectureDescription> dropped_;
  std::set<std::string, std::less<>> doubtful_;
  std::optional<Section> section_;
  /// The line that ended the last section.
  const StructureLine* section_end_ = nullptr;
  std::string default_host_;
  std::vector<StandaloneLine> standalone_lines_;
  AccessRuleParser access_rule_parser_;
  SupervisionRules supervision_rules_;
  std::map<std::string, const SourceLine*, std::less<>> subarchitecture_lines_;
  std::map<std::string, const StructureLine*, std::less<>> component_lines_;
  std::size_t next_number_ = 0;
};

} // namespace

Structure parse_structure(Preprocessed& input, const ParseOptions& options, DiagnosticLog& log) {
  return StatementReader(input, options, log).run();
}

} // namespace castor::cast
