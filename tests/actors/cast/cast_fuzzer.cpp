// Feeds arbitrary bytes to the parser. The input is cut into files at lines of the form
// `=== name`, so that INCLUDE lines find them; nothing outside of the input is looked at.

#include "castor/actors/cast/json.hpp"
#include "castor/actors/cast/parser.hpp"
#include "castor/tests/support/fuzzing.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace {

using Files = std::map<std::string, std::string>;

/// The first file is called main.cast.
Files split_files(std::string_view input) {
  constexpr std::string_view separator = "\n=== ";
  Files files;
  std::string name = "main.cast";
  while (true) {
    auto end = std::min(input.find(separator), input.size());
    files.emplace(name, input.substr(0, end));
    if (end == input.size())
      return files;
    input.remove_prefix(end + separator.size());
    auto line_end = std::min(input.find('\n'), input.size());
    name = input.substr(0, line_end);
    input.remove_prefix(line_end);
  }
}

castor::cast::ParseOptions options_with(Files files) {
  auto options = castor::test::hermetic_options();
  options.working_directory = "/robot";
  options.variables["preset"] = "value";
  options.environment = [](const std::string& name) -> std::optional<std::string> {
    return name.size() % 2 == 0 ? std::nullopt : std::optional<std::string>("value of " + name);
  };
  options.load = [files = std::move(files)](const std::string& path,
                                            std::size_t) -> castor::FileContent {
    auto found = files.find(path);
    if (found == files.end())
      return {std::nullopt, "no such file"};
    return {found->second, {}};
  };
  options.limits.include_depth = 8;
  options.limits.expanded_bytes = 20'000;
  return options;
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name is libFuzzer's
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace castor::cast;
  using castor::test::require;
  std::string_view input(reinterpret_cast<const char*>(data), size);
  auto result = parse_file("main.cast", options_with(split_files(input)));
  auto has_error = std::any_of(
    result.diagnostics.begin(), result.diagnostics.end(),
    [](const castor::Diagnostic& found) { return found.severity == castor::Severity::error; });
  require(result.ok() != has_error);
  require(result.diagnostics.size() <= 21);
  require(!to_json(result).empty());
  require(render(result.diagnostics).find('\x1b') == std::string::npos);
  if (result.ok()) {
    const auto& architecture = *result.architecture;
    require(!architecture.subarchitectures.empty() || !architecture.standalone.empty());
    for (const auto& subarchitecture : architecture.subarchitectures) {
      require(architecture.may_write(subarchitecture.name, subarchitecture.name));
      for (const auto& component : subarchitecture.components)
        require(architecture.component(component.name) == &component);
    }
  }
  return 0;
}
