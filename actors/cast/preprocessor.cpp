#include "castor/actors/cast/preprocessor.hpp"

#include "castor/actors/cast/conditions.hpp"
#include "castor/actors/cast/keywords.hpp"
#include "castor/actors/cast/option_flags.hpp"
#include "castor/actors/cast/paths.hpp"
#include "castor/actors/cast/scope.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace castor::cast {

namespace {

/// `IFDEF(x)`: looks like a conditional, but is none of those that exist.
bool looks_like_condition(std::string_view text) noexcept {
  if (!text.starts_with("IF"))
    return false;
  auto end =
    std::find_if_not(text.begin(), text.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
  auto rest = trim(text.substr(static_cast<std::size_t>(end - text.begin())));
  return !rest.empty() && rest.front() == '(';
}

class Preprocessor {
public:
  Preprocessor(const Source& source, const ParseOptions& options,
               const std::string& working_directory, DiagnosticLog& log)
    : lines_(source.lines), options_(options), working_directory_(working_directory), log_(log),
      scope_(options.limits, log) {
    for (std::size_t i = 0; i < lines_.size(); ++i)
      if (lines_[i].text == multiline_end)
        last_multiline_end_ = i;
  }

  Preprocessed run(const std::string& main_dir) {
    for (const auto& [name, value] : options_.offered_variables)
      scope_.variables().define(name, value);
    for (const auto& [name, value] : options_.variables)
      preset(name, value);
    scope_.variables().define(main_dir_variable, main_dir);
    for (next_ = 0; next_ < lines_.size() && !scope_.exhausted();) {
      const auto& line = lines_[next_++];
      if (line.kind == SourceLine::Kind::enter_file)
        enter_file(line);
      else
        process(line);
    }
    if (!scope_.exhausted())
      check_all_blocks_closed();
    result_.truncated = scope_.exhausted();
    result_.hosts = std::move(scope_.hosts());
    return std::move(result_);
  }

private:
  void preset(const std::string& name, const std::string& value) {
    if (is_identifier(name))
      scope_.variables().define(name, value);
    else
      log_.report(Severity::error, SourceLocation("command line", 0),
                  in_quotes(name) + " cannot be the name of a variable",
                  "a name is a letter, then letters, digits and underscores");
  }

  void enter_file(const SourceLine& line) {
    if (line.unit.get() == current_unit_ && !current_dir_changed_)
      return;
    current_unit_ = line.unit.get();
    current_dir_changed_ = false;
    const auto& file = line.unit->file;
    auto directory = directory_for_users(file, working_directory_);
    scope_.variables().define(config_dir_variable, directory);
    scope_.variables().define(current_dir_variable, std::move(directory));
    scope_.variables().define(current_file_variable, path_for_users(file, working_directory_));
  }

  void process(const SourceLine& line) {
    if (line.text.empty())
      return;
    if (line.text.front() == '#')
      comment(line);
    else if (auto directive = match_directive(line.text))
      conditional(line, *directive);
    else if (auto command = match_variable_command(line.text))
      variable_command(line, *command);
    else if (!blocks_.enabled())
      return;
    else if (line.text.starts_with(host_name_keyword))
      host_name(line);
    else if (looks_like_condition(line.text))
      unknown_condition(line);
    else
      structure(line);
  }

  void comment(const SourceLine& line) {
    if (!line.text.starts_with(expand_comment))
      return;
    if (auto text = scope_.expand(line, line.text, Undefined::drop, Remarks::no))
      result_.expansions.push_back(std::move(*text));
  }

  void conditional(const SourceLine& line, const KeywordMatch<Directive>& directive) {
    if (directive.keyword == Directive::otherwise || directive.keyword == Directive::end) {
      if (directive.keyword == Directive::otherwise && is_else_if(line.text)) {
        log_.report(Severity::error, line, "there is no ELSE with a condition",
                    "write ELSE, then the second IF... on a line of its own with its own ENDIF");
        return;
      }
      remark_on_rest(line, directive);
      finish_block(line, directive);
      return;
    }
    auto remarks = blocks_.enabled() ? Remarks::yes : Remarks::no;
    auto condition = evaluate_condition(directive, line.text, [&](std::string_view text) {
      return scope_.expand(line, text, Undefined::drop, remarks);
    });
    if (!condition.value && !condition.problem.empty())
      log_.report(Severity::error, line, std::move(condition.problem), std::move(condition.remedy));
    else if (!condition.problem.empty() && remarks == Remarks::yes)
      log_.report(Severity::warning, line, std::move(condition.problem),
                  std::move(condition.remedy));
    blocks_.open(line, condition.value.value_or(true));
  }

  static bool is_else_if(std::string_view text) noexcept {
    auto rest = trim(text.substr(std::string_view("ELSE").size()));
    return match_directive(rest).has_value() || looks_like_condition(rest);
  }

  void remark_on_rest(const SourceLine& line, const KeywordMatch<Directive>& directive) {
    auto rest = trim(line.text.substr(directive.word.size()));
    if (!rest.empty() && rest.front() != '#')
      log_.report(Severity::warning, line,
                  in_quotes(rest) + " behind " + std::string(directive.word) + " is ignored",
                  "write # before a comment");
  }

  void finish_block(const SourceLine& line, const KeywordMatch<Directive>& directive) {
    auto is_else = directive.keyword == Directive::otherwise;
    switch (is_else ? blocks_.otherwise() : blocks_.close()) {
      case ConditionStack::Outcome::done:
        return;
      case ConditionStack::Outcome::no_block_open:
        log_.report(Severity::error, line,
                    std::string(directive.word) + " without an IF... line before it",
                    "remove it, or look for an ENDIF too many above");
        return;
      case ConditionStack::Outcome::second_else:
        log_.report(Severity::error, line,
                    "second ELSE of the block that begins at " +
                      to_string(blocks_.open_lines().back()->where()),
                    "remove it, or look for a missing ENDIF above");
        return;
    }
  }

  void unknown_condition(const SourceLine& line) {
    auto word = line.text.substr(0, std::min(line.text.find('('), line.text.size()));
    log_.report(Severity::error, line, "there is no conditional " + in_quotes(trim(word)),
                "write IFEQ, IFNEQ, IFTRUE, IFFALSE, IFOPTANY or IFOPTALL");
    blocks_.open(line, true);
  }

  void check_all_blocks_closed() {
    auto open = blocks_.open_lines();
    if (open.empty())
      return;
    constexpr std::size_t most_listed = 8;
    std::string message = open.size() == 1 ? "this block has no ENDIF"
                                           : std::to_string(open.size()) + " blocks have no ENDIF:";
    for (std::size_t i = 0; open.size() > 1 && i < std::min(open.size(), most_listed); ++i)
      message +=
        (i > 0 ? ", " : " ") + in_quotes(open[i]->text) + " at " + to_string(open[i]->where());
    log_.report(Severity::error, *open.back(), std::move(message),
                "write one ENDIF line for each IF... line");
  }

  /// Also runs for disabled blocks, so that the text of a multi-line value is text there, too.
  void variable_command(const SourceLine& line, const KeywordMatch<VariableCommand>& command) {
    auto rest = line.text.substr(command.word.size());
    while (!rest.empty() && rest.front() >= 'A' && rest.front() <= 'Z')
      rest.remove_prefix(1);
    auto is_separated = !rest.empty() && is_blank(rest.front());
    auto assignment = is_separated ? parse_assignment(rest) : std::nullopt;
    if (!assignment) {
      if (blocks_.enabled())
        log_.report(Severity::error, line, "this is no assignment to a variable",
                    "write " + std::string(command.word) +
                      " name=value; a name is a letter, then letters, digits and underscores");
      return;
    }
    std::optional<std::string> multiline;
    if (assignment->value.starts_with(multiline_begin)) {
      multiline = take_multiline(line, assignment->value.substr(multiline_begin.size()));
      if (!multiline)
        return;
    }
    if (!blocks_.enabled())
      return;
    if (command.glued)
      log_.report(Severity::warning, line,
                  "read as " + std::string(command.word) + " with the letters behind it ignored");
    if (!multiline && assignment->value.find(" #") != std::string_view::npos)
      log_.report(Severity::note, line, "the text from # on is part of the value",
                  "put a comment on a line of its own");
    assign(line, command.keyword, assignment->name,
           multiline ? std::string_view(*multiline) : assignment->value);
  }

  /// The lines up to the closing tag as one; nothing if they are not to be used.
  std::optional<std::string> take_multiline(const SourceLine& opening, std::string_view first) {
    if (last_multiline_end_ < next_ || last_multiline_end_ == none) {
      log_.report(blocks_.enabled() ? Severity::error : Severity::warning, opening,
                  "the multi-line value has no end",
                  "write </multiline> on a line of its own behind the last line of the value");
      return std::nullopt;
    }
    std::string value(trim(first));
    for (; lines_[next_].text != multiline_end; ++next_) {
      const auto& line = lines_[next_];
      if (line.kind == SourceLine::Kind::enter_file) {
        enter_file(line);
        continue;
      }
      if (line.text.starts_with("#"))
        continue;
      if (match_variable_command(line.text) &&
          line.text.find(multiline_begin) != std::string_view::npos)
        log_.report(Severity::warning, line,
                    "this line is part of the multi-line value that begins at " +
                      to_string(opening.where()),
                    "is </multiline> missing above?");
      // Past the limit nothing more needs to be kept: the value is refused in the end.
      if (value.size() > options_.limits.line_bytes)
        continue;
      if (!value.empty())
        value += ' ';
      value += line.text;
    }
    ++next_;
    if (!scope_.admit(opening, value))
      return std::nullopt;
    return value;
  }

  void assign(const SourceLine& line, VariableCommand command, std::string_view name,
              std::string_view text) {
    const auto* current = scope_.variables().find(name);
    if (command == VariableCommand::set_default && current != nullptr)
      return;
    auto value = scope_.expand(line, text, Undefined::drop, Remarks::yes);
    if (!value)
      return;
    auto merges =
      command == VariableCommand::set_options || command == VariableCommand::default_options;
    if (merges && current != nullptr) {
      *value = merge_flags(*current, *value,
                           command == VariableCommand::set_options ? Merge::replace : Merge::keep);
      if (!scope_.admit(line, *value))
        return;
    } else if (command == VariableCommand::set && options_.variables.count(std::string(name)) > 0) {
      log_.report(Severity::warning, line,
                  "this overwrites the value of " + in_quotes(name) + " from the command line",
                  "write VARDEFAULT instead of SETVAR to let the command line win");
    }
    if (name == config_dir_variable || name == current_dir_variable ||
        name == current_file_variable)
      overwrite_current(line, name);
    scope_.variables().define(name, std::move(*value));
  }

  void overwrite_current(const SourceLine& line, std::string_view name) {
    current_dir_changed_ = true;
    log_.report(Severity::warning, line,
                in_quotes(name) +
                  " is set anew at each INCLUDE and at the end of each included file",
                "use a variable with another name");
  }

  void host_name(const SourceLine& line) {
    auto rest = line.text.substr(host_name_keyword.size());
    auto is_separated = !rest.empty() && is_blank(rest.front());
    auto name = take_word(rest);
    auto expression = take_word(rest);
    auto is_complete = is_separated && is_identifier(name) && !expression.empty() &&
                       expression.find('#') == std::string_view::npos && trim(rest).empty();
    if (!is_complete) {
      auto has_comment = line.text.find('#') != std::string_view::npos;
      log_.report(Severity::error, line, "this is no definition of a host",
                  has_comment ? "put the comment on a line of its own: HOSTNAME Name address"
                              : "write HOSTNAME Name address; a name is a letter, then letters, "
                                "digits and underscores");
    } else if (section_seen_ != nullptr) {
      // The first definition wins in any case, so only an undefined host makes a difference.
      log_.report(scope_.hosts().is_defined(name) ? Severity::warning : Severity::error, line,
                  "HOSTNAME comes too late, behind " + to_string(section_seen_->where()),
                  "move it above the first section");
    } else {
      define_host(line, name, expression);
    }
  }

  void define_host(const SourceLine& line, std::string_view name, std::string_view expression) {
    auto value = scope_.expand(line, expression, Undefined::keep, Remarks::yes);
    if (!value)
      return;
    if (value->empty() || std::any_of(value->begin(), value->end(), is_blank)) {
      log_.report(Severity::error, line, in_quotes(*value) + " is not the address of a host",
                  "write one word: an address, or the [Name] of another host");
      return;
    }
    if (value->starts_with('$')) {
      log_.report(Severity::error, line, "environment variables are not replaced in HOSTNAME lines",
                  "write the address, or " + shorten(*value, 80) + " where the host is used");
      return;
    }
    auto resolved = scope_.hosts().resolve(*value);
    switch (scope_.hosts().define(name, resolved.host)) {
      case HostTable::Outcome::defined:
        if (!resolved.defined)
          report_undefined_host(scope_.hosts(), bracketed_host(*value), line, log_);
        scope_.hosts().use(*value);
        return;
      case HostTable::Outcome::defined_before:
        return;
      case HostTable::Outcome::used_before:
        log_.report(Severity::warning, line,
                    "this has no effect: " + in_quotes(name) +
                      " was used above and stands for localhost since then",
                    "move the line above the first use of the name");
        return;
    }
  }

  void structure(const SourceLine& line) {
    if (section_seen_ == nullptr && match_section_keyword(line.text))
      section_seen_ = &line;
    if (line.text.find("%(") == std::string_view::npos) {
      result_.lines.push_back({line.text, &line});
      return;
    }
    auto expanded = scope_.expand(line, line.text, Undefined::keep, Remarks::yes);
    if (!expanded)
      return;
    auto text = trim(result_.texts.emplace_back(std::move(*expanded)));
    if (!text.empty() && text.front() != '#')
      result_.lines.push_back({text, &line});
  }

  static constexpr auto none = static_cast<std::size_t>(-1);

  const std::vector<SourceLine>& lines_;
  const ParseOptions& options_;
  const std::string& working_directory_;
  DiagnosticLog& log_;
  Preprocessed result_;
  Scope scope_;
  ConditionStack blocks_;
  std::size_t next_ = 0;
  std::size_t last_multiline_end_ = none;
  const SourceLine* section_seen_ = nullptr;
  const SourceUnit* current_unit_ = nullptr;
  bool current_dir_changed_ = false;
};

} // namespace

Preprocessed preprocess(const Source& source, const ParseOptions& options,
                        const std::string& main_dir, const std::string& working_directory,
                        DiagnosticLog& log) {
  return Preprocessor(source, options, working_directory, log).run(main_dir);
}

} // namespace castor::cast
