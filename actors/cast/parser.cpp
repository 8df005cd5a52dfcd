#include "castor/actors/cast/parser.hpp"

#include "castor/actors/cast/given_variables.hpp"
#include "castor/actors/cast/grammar.hpp"
#include "castor/actors/cast/paths.hpp"
#include "castor/actors/cast/preprocessor.hpp"
#include "castor/actors/cast/reader.hpp"
#include "castor/base/diagnostic_log.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

namespace castor::cast {

namespace {

std::string working_directory_of(const ParseOptions& options) {
  if (!options.working_directory.empty())
    return options.working_directory;
  std::error_code error;
  return std::filesystem::current_path(error).string();
}

ParseResult parse(const Source& source, const std::string& file, const ParseOptions& options,
                  DiagnosticLog& log) {
  ParseResult result;
  result.understood.is_incomplete = true;
  if (!source.truncated) {
    // What could not be read may have the variables, and components.
    auto is_complete = !log.has_errors();
    if (is_complete)
      check_given_variables(source, options, log);
    auto working_directory = working_directory_of(options);
    auto config_dir = directory_for_users(file, working_directory);
    auto preprocessed = preprocess(source, options, config_dir, working_directory, log);
    result.expansions = std::move(preprocessed.expansions);
    if (!preprocessed.truncated) {
      auto structure = parse_structure(preprocessed, options, log);
      auto& architecture = structure.architecture;
      if (!log.has_errors() && architecture.subarchitectures.empty() &&
          architecture.standalone.empty())
        log.report(Severity::error, SourceLocation(file, 0), "the file describes no components",
                   "write a SUBARCHITECTURE section or a COMPONENT line");
      architecture.file = file;
      architecture.config_dir = std::move(config_dir);
      if (!log.has_errors())
        result.architecture = std::move(architecture);
      else
        result.understood.architecture = std::move(architecture);
      result.understood.doubtful = std::move(structure.doubtful);
      result.understood.is_incomplete = !is_complete;
    }
  }
  result.diagnostics = log.take();
  return result;
}

} // namespace

ParseResult parse_file(const std::string& file, const ParseOptions& options) {
  DiagnosticLog log(options.limits.diagnostics);
  auto source = read_source(file, options, log);
  return parse(source, file, options, log);
}

ParseResult parse_string(std::string_view text, const std::string& file_name,
                         const ParseOptions& options) {
  DiagnosticLog log(options.limits.diagnostics);
  auto source = read_source(text, file_name, options, log);
  return parse(source, file_name, options, log);
}

} // namespace castor::cast
