#include "castor/actors/cast/reader.hpp"

#include "castor/actors/cast/keywords.hpp"
#include "castor/actors/cast/paths.hpp"
#include "castor/base/text.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>

namespace castor::cast {

namespace {

constexpr std::size_t longest_path = 4096;

using Text = std::shared_ptr<const std::string>;

/// Cuts off the next line; a line ends at LF, CR or CR LF.
std::string_view take_line(std::string_view& rest) noexcept {
  auto end = std::min(rest.find_first_of("\r\n"), rest.size());
  auto line = rest.substr(0, end);
  auto is_pair = rest.substr(end).starts_with("\r\n");
  rest.remove_prefix(std::min(end + (is_pair ? 2 : 1), rest.size()));
  return line;
}

class Reader {
public:
  Reader(const ParseOptions& options, DiagnosticLog& log) : options_(options), log_(log) {
    // nop
  }

  Source take() { return std::move(source_); }

  void read_main(const std::string& file) {
    SourceLocation where(file, 0);
    std::string error;
    if (auto text = load(file, error)) {
      read_unit(std::make_shared<const SourceUnit>(SourceUnit{file, {}}), text);
    } else {
      log_.report(Severity::error, where, "cannot read " + in_quotes(file) + ": " + error);
      source_.truncated = true;
    }
  }

  void read_text(std::string_view text, const std::string& file) {
    if (auto flaw = why_no_text(text); !flaw.empty()) {
      log_.report(Severity::error, SourceLocation(file, 0),
                  "cannot read " + in_quotes(file) + ": " + flaw);
      source_.truncated = true;
      return;
    }
    read_unit(std::make_shared<const SourceUnit>(SourceUnit{file, {}}), keep(std::string(text)));
  }

private:
  /// Puts the included file, if it can be had, in the place of an INCLUDE line.
  void include(const SourceLine& line) {
    auto rest = line.text.substr(include_keyword.size());
    if (!rest.empty() && !is_blank(rest.front()))
      log_.report(Severity::warning, line, "the character behind INCLUDE is not part of the path",
                  "put a blank between INCLUDE and the path");
    auto path = trim(rest.substr(std::min<std::size_t>(1, rest.size())));
    if (path.empty()) {
      log_.report(Severity::error, line, "INCLUDE without a path", "write INCLUDE other.cast");
      return;
    }
    auto target = include_target(line.unit->file, path);
    if (target.size() > longest_path) {
      log_.report(Severity::error, line,
                  "the path is longer than " + std::to_string(longest_path) + " bytes");
      return;
    }
    auto identity = std::filesystem::path(target).lexically_normal().string();
    if (auto first = std::find(open_.begin(), open_.end(), identity); first != open_.end()) {
      std::string cycle;
      for (auto i = first; i != open_.end(); ++i)
        cycle += *i + " -> ";
      log_.report(Severity::error, line, "files include each other in a cycle: " + cycle + identity,
                  "remove one of these INCLUDE lines");
      return;
    }
    if (open_.size() > options_.limits.include_depth) {
      log_.report(Severity::error, line,
                  "files include each other more than " +
                    std::to_string(options_.limits.include_depth) + " levels deep",
                  "look for a cycle, or include the files side by side");
      return;
    }
    std::string error;
    auto text = load(target, error);
    if (!text) {
      log_.report(Severity::error, line, "cannot read " + in_quotes(target) + ": " + error,
                  include_remedy(path));
      return;
    }
    SourceUnit unit{target, line.where()};
    read_unit(std::make_shared<const SourceUnit>(std::move(unit)), text);
  }

  static std::string include_remedy(std::string_view path) {
    if (path.find('#') != std::string_view::npos)
      return "put the comment on a line of its own: all that follows INCLUDE is the path";
    if (path.find("%(") != std::string_view::npos || path.find('$') != std::string_view::npos)
      return "write the path in full: variables are not replaced in INCLUDE lines";
    return "a path is absolute or relative to the directory of the including file";
  }

  void read_unit(const std::shared_ptr<const SourceUnit>& unit, const Text& text) {
    open_.push_back(std::filesystem::path(unit->file).lexically_normal().string());
    if (admit_bytes(unit, text->size())) {
      enter(unit);
      read_lines(unit, *text);
    }
    open_.pop_back();
  }

  void read_lines(const std::shared_ptr<const SourceUnit>& unit, std::string_view rest) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (rest.starts_with(byte_order_mark))
      rest.remove_prefix(byte_order_mark.size());
    for (std::uint32_t number = 1; !rest.empty() && !source_.truncated; ++number) {
      auto text = trim(take_line(rest));
      SourceLine line{text, unit, number, next_order(), SourceLine::Kind::text};
      if (text.size() > options_.limits.line_bytes) {
        log_.report(Severity::error, line,
                    "the line is longer than " + std::to_string(options_.limits.line_bytes) +
                      " bytes",
                    "is this a .cast file? Otherwise split the line, for instance with variables");
      } else if (text.starts_with(include_keyword)) {
        include(line);
        enter(unit);
      } else {
        push(std::move(line));
      }
    }
  }

  /// From here on lines are those of `unit`.
  void enter(const std::shared_ptr<const SourceUnit>& unit) {
    push({{}, unit, 0, next_order(), SourceLine::Kind::enter_file});
  }

  void push(SourceLine line) {
    if (source_.lines.size() >= options_.limits.lines) {
      if (!source_.truncated)
        log_.report(Severity::error, line,
                    "there are more than " + std::to_string(options_.limits.lines) +
                      " lines, included files counted each time",
                    "look for files that are included over and over");
      source_.truncated = true;
      return;
    }
    source_.lines.push_back(std::move(line));
  }

  bool admit_bytes(const std::shared_ptr<const SourceUnit>& unit, std::size_t bytes) {
    if (bytes <= options_.limits.total_bytes - total_bytes_) {
      total_bytes_ += bytes;
      return true;
    }
    log_.report(Severity::error, SourceLine{{}, unit, 0, next_order(), SourceLine::Kind::text},
                "the files are longer than " + std::to_string(options_.limits.total_bytes) +
                  " bytes together, included files counted each time",
                "look for files that are included over and over");
    source_.truncated = true;
    return false;
  }

  /// Each file is read once, however often it is included: one parse sees one version of it.
  Text load(const std::string& path, std::string& error) {
    if (auto known = loaded_.find(path); known != loaded_.end()) {
      error = known->second.error;
      return known->second.text;
    }
    Loaded result;
    auto content = options_.load(path, options_.limits.total_bytes);
    if (!content.text) {
      result.error = content.error.empty() ? "it cannot be loaded" : content.error;
    } else if (auto flaw = why_no_text(*content.text); !flaw.empty()) {
      result.error = flaw;
    } else {
      result.text = keep(std::move(*content.text));
    }
    error = result.error;
    return loaded_.emplace(path, std::move(result)).first->second.text;
  }

  static std::string why_no_text(std::string_view text) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
      return "it is encoded in UTF-16; save it as UTF-8";
    auto zero = text.find('\0');
    if (zero == std::string_view::npos)
      return {};
    auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
    return "it is no text file: line " + std::to_string(line) + " contains a zero byte";
  }

  Text keep(std::string text) {
    source_.texts.push_back(std::make_shared<const std::string>(std::move(text)));
    return source_.texts.back();
  }

  std::uint32_t next_order() const noexcept {
    return static_cast<std::uint32_t>(source_.lines.size());
  }

  struct Loaded {
    Text text;
    std::string error;
  };

  const ParseOptions& options_;
  DiagnosticLog& log_;
  Source source_;
  std::map<std::string, Loaded> loaded_;
  /// The files that are being read, outermost first.
  std::vector<std::string> open_;
  std::size_t total_bytes_ = 0;
};

} // namespace

Source read_source(const std::string& file, const ParseOptions& options, DiagnosticLog& log) {
  Reader reader(options, log);
  reader.read_main(file);
  return reader.take();
}

Source read_source(std::string_view text, const std::string& file, const ParseOptions& options,
                   DiagnosticLog& log) {
  Reader reader(options, log);
  reader.read_text(text, file);
  return reader.take();
}

} // namespace castor::cast
