#include "castor/tests/actors/cast/support.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace castor::cast::test {

ParseOptions options_for(World world) {
  ParseOptions options;
  options.working_directory = "/robot";
  options.environment =
    [values = std::move(world.environment)](const std::string& name) -> std::optional<std::string> {
    auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional(found->second);
  };
  options.load = [files = std::move(world.files)](const std::string& path,
                                                  std::size_t) -> FileContent {
    auto found = files.find(path);
    if (found == files.end())
      return {std::nullopt, "no such file"};
    return {found->second, {}};
  };
  return options;
}

ParseResult parse(std::string_view text, World world) {
  return parse_string(text, "main.cast", options_for(std::move(world)));
}

std::string system_with(std::string_view lines) {
  return "HOST localhost\n"
         "SUBARCHITECTURE sa\n"
         "CPP WM SubarchitectureWorkingMemory\n"
         "CPP TM AlwaysPositiveTaskManager\n" +
         std::string(lines);
}

std::vector<std::string> values(std::string_view text, World world) {
  auto result = parse(text, std::move(world)).expansions;
  for (auto& line : result)
    line.erase(0, std::string_view("#EXPAND ").size());
  return result;
}

testing::AssertionResult is_clean(const ParseResult& result) {
  if (result.ok() && result.diagnostics.empty())
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << "found:\n" << render(result.diagnostics);
}

testing::AssertionResult reports(const ParseResult& result, Severity severity, std::size_t line,
                                 std::string_view message_part, std::string_view remedy_part,
                                 std::string_view file) {
  auto matches = [&](const Diagnostic& diagnostic) {
    return diagnostic.severity == severity && diagnostic.where.line() == line &&
           diagnostic.where.file() == file &&
           diagnostic.message.find(message_part) != std::string::npos &&
           diagnostic.remedy.find(remedy_part) != std::string::npos;
  };
  if (std::any_of(result.diagnostics.begin(), result.diagnostics.end(), matches))
    return testing::AssertionSuccess();
  return testing::AssertionFailure()
         << "no " << to_string(severity) << " at " << file << ":" << line << " with '"
         << message_part << "' and remedy '" << remedy_part << "'; found:\n"
         << render(result.diagnostics);
}

std::size_t count(const ParseResult& result, Severity severity) {
  return static_cast<std::size_t>(
    std::count_if(result.diagnostics.begin(), result.diagnostics.end(),
                  [severity](const Diagnostic& d) { return d.severity == severity; }));
}

} // namespace castor::cast::test
