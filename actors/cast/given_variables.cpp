#include "castor/actors/cast/given_variables.hpp"

#include "castor/actors/cast/keywords.hpp"
#include "castor/actors/cast/variables.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace castor::cast {

namespace {

constexpr std::size_t most_listed = 40;

bool is_set_by_parser(std::string_view name) noexcept {
  return name == current_dir_variable || name == current_file_variable ||
         name == config_dir_variable || name == main_dir_variable;
}

} // namespace

std::set<std::string, std::less<>> variables_in(const Source& source) {
  std::set<std::string, std::less<>> result;
  auto add = [&](std::string_view name) {
    if (is_identifier(name) && !is_set_by_parser(name) && result.find(name) == result.end())
      result.emplace(name);
  };
  for (auto& line : source.lines) {
    auto text = line.text;
    if (text.starts_with('#') && !text.starts_with(expand_comment))
      continue;
    if (auto command = match_variable_command(text)) {
      auto rest = text.substr(command->word.size());
      while (!rest.empty() && rest.front() >= 'A' && rest.front() <= 'Z')
        rest.remove_prefix(1);
      if (auto assignment = parse_assignment(rest))
        add(assignment->name);
    }
    for (auto begin = text.find("%("); begin != std::string_view::npos;
         begin = text.find("%(", begin + 2)) {
      auto end = text.find(')', begin);
      if (end == std::string_view::npos)
        break;
      add(text.substr(begin + 2, end - begin - 2));
    }
  }
  return result;
}

void check_given_variables(const Source& source, const ParseOptions& options, DiagnosticLog& log) {
  if (options.variables.empty())
    return;
  const SourceLocation where("command line", 0);
  auto known = variables_in(source);
  for (auto& [name, value] : options.variables) {
    if (is_set_by_parser(name)) {
      log.report(Severity::error, where, in_quotes(name) + " is set by the parser alone",
                 "it describes the location of the file; use a variable with another name");
      continue;
    }
    if (!is_identifier(name) || known.find(name) != known.end())
      continue;
    std::vector<std::string> shortened;
    for (auto& x : known)
      shortened.push_back(shorten(x, 80));
    auto remedy = did_you_mean(name, {known.begin(), known.end()});
    if (!remedy.empty())
      remedy += ' ';
    remedy += known.empty() ? "the file uses no variables"
                            : "the file's variables are: " + list_of(shortened, most_listed);
    log.report(Severity::error, where, "the file has no variable " + in_quotes(name),
               std::move(remedy));
  }
}

} // namespace castor::cast
