#include "castor/tools/cli/man_page.hpp"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <string_view>
#include <vector>

namespace castor::cli {

namespace {

/// What programs of this kind end with, where the command does not say more.
constexpr const char* usual_exit_status =
  "0 if all went well, 1 if a component failed or a check found errors, 2 if the input (the "
  "command "
  "line, a file, the system that is asked) is not as it has to be.";

/// Text in which nothing is a request or an escape of roff.
std::string roff(std::string_view text, bool literal_dashes = false) {
  std::string result;
  bool begins_line = true;
  for (auto c : text) {
    if (begins_line && (c == '.' || c == '\''))
      result += "\\&";
    begins_line = c == '\n';
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      // Without these, a dash, an accent or a circumflex is printed as a typographic one, which
      // cannot be copied into a terminal.
      case '-':
        result += literal_dashes ? "\\-" : "-";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string bold(std::string_view text) {
  return "\\fB" + roff(text, true) + "\\fR";
}

std::string italic(std::string_view text) {
  return "\\fI" + roff(text, true) + "\\fR";
}

bool ends_word(char c) {
  return !std::isalnum(static_cast<unsigned char>(c));
}

/// Text of a help line or a footer: options in it are bold, and so is what stands in `quotes`.
std::string marked_up(std::string_view text) {
  std::string result;
  std::size_t at = 0;
  auto plain_from = at;
  auto flush = [&](std::size_t end) { result += roff(text.substr(plain_from, end - plain_from)); };
  while (at < text.size()) {
    if (text[at] == '`') {
      if (auto end = text.find('`', at + 1); end != text.npos) {
        flush(at);
        result += bold(text.substr(at + 1, end - at - 1));
        plain_from = at = end + 1;
        continue;
      }
    }
    if (text.substr(at, 2) == "--" && (at == 0 || ends_word(text[at - 1])) &&
        at + 2 < text.size() && std::isalpha(static_cast<unsigned char>(text[at + 2]))) {
      auto end = at + 2;
      while (end < text.size() && (!ends_word(text[end]) || text[end] == '-'))
        ++end;
      flush(at);
      result += bold(text.substr(at, end - at));
      plain_from = at = end;
      continue;
    }
    ++at;
  }
  flush(at);
  return result;
}

/// Lines of at most some 80 characters; who reads the page sees others. None of them is a request.
std::string wrapped(const std::string& text) {
  constexpr std::size_t width = 78;
  std::string result;
  std::size_t column = 0;
  std::istringstream words{text};
  for (std::string word; words >> word;) {
    auto breaks = column > 0 && column + 1 + word.size() > width;
    if (column > 0)
      result += breaks ? '\n' : ' ';
    if (breaks && word.front() == '.')
      result += "\\&";
    column = column == 0 || breaks ? word.size() : column + 1 + word.size();
    result += word;
  }
  return result;
}

/// A paragraph of a help line or a footer.
std::string prose(std::string_view text) {
  return wrapped(marked_up(text));
}

std::string sentence(std::string text) {
  if (text.empty())
    return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (text.back() != '.' && text.back() != '?' && text.back() != '!')
    text += '.';
  return text;
}

bool begins_with(std::string_view text, std::string_view begin) {
  return text.substr(0, begin.size()) == begin;
}

std::string without_leading(const char* characters, const std::string& text) {
  auto begin = text.find_first_not_of(characters);
  return begin == text.npos ? std::string{} : text.substr(begin);
}

/// A footer, taken apart.
struct Footer {
  std::vector<std::string> prose;
  std::string exit_status;
  std::vector<std::string> examples;
};

Footer read_footer(const std::string& text) {
  Footer result;
  bool in_examples = false;
  std::istringstream lines{text};
  for (std::string line; std::getline(lines, line);) {
    if (begins_with(line, "Example")) {
      in_examples = true;
      auto colon = line.find(':');
      if (colon == line.npos)
        continue;
      line = ' ' + line.substr(colon + 1);
    }
    in_examples = in_examples && (line.empty() || line.front() == ' ');
    auto content = without_leading(" ", line);
    if (content.empty())
      continue;
    if (in_examples)
      result.examples.push_back(content);
    else if (begins_with(content, "Exit status"))
      // "Exit status: 0 if ..." or "Exit status 1 if ...": the title of the section says the
      // beginning.
      result.exit_status = without_leading(": ", content.substr(std::string{"Exit status"}.size()));
    else
      result.prose.push_back(content);
  }
  return result;
}

std::string call_of(const Command& command) {
  return fmt::format("{}", fmt::join(command.path, " "));
}

/// Its own; otherwise those of the command that it is part of that show it; otherwise one of each
/// part.
std::vector<std::string> examples_of(const Command& command, const Command& program) {
  auto result = read_footer(command.footer).examples;
  if (!result.empty())
    return result;
  auto call = call_of(command);
  for (auto* other : all_commands(program))
    for (auto& x : read_footer(other->footer).examples)
      if (begins_with(x, call) && (x.size() == call.size() || x[call.size()] == ' '))
        result.push_back(x);
  if (!command.commands.empty() && command.path.size() == 1) {
    result.clear();
    for (auto& part : command.commands)
      if (auto examples = examples_of(part, part); !examples.empty())
        result.push_back(examples.front());
  }
  return result;
}

std::string synopsis(const Command& command) {
  auto result = bold(call_of(command)) + " [" + italic("OPTION") + " ...]";
  for (auto& x : command.positionals) {
    auto text = italic(x.value) + (x.repeatable ? " ..." : "");
    result += ' ' + (x.required ? text : '[' + text + ']');
  }
  if (!command.commands.empty())
    result += ' ' + italic("COMMAND") + " [" + italic("ARGUMENT") + " ...]";
  return result;
}

std::string entry(const Argument& x) {
  std::string head;
  for (auto& name : x.names)
    head += (head.empty() ? "" : ", ") + bold(name);
  if (!x.value.empty())
    head += (head.empty() ? "" : " ") + italic(x.value);
  auto text = sentence(x.help);
  if (x.kind == ValueKind::choice)
    text += fmt::format(" One of {}.", fmt::join(x.choices, ", "));
  if (!x.range.empty())
    text += " In " + x.range + '.';
  if (!x.default_value.empty())
    text += " Default: " + x.default_value + '.';
  return ".TP\n" + head + '\n' + prose(text) + '\n';
}

std::string section(const std::string& title, const std::string& text) {
  return text.empty() ? std::string{} : ".SH " + title + '\n' + text;
}

std::string reference(const std::string& page) {
  return "\\fB" + roff(page, true) + "\\fR(1)";
}

const Command* parent_of(const Command& command, const Command& program) {
  for (auto* x : all_commands(program))
    if (x->path.size() + 1 == command.path.size() &&
        std::equal(x->path.begin(), x->path.end(), command.path.begin()))
      return x;
  return nullptr;
}

std::string see_also(const Command& command, const Command& program) {
  std::vector<std::string> pages;
  auto* parent = parent_of(command, program);
  if (parent)
    pages.push_back(man_page_name(*parent));
  // Its parts, and what it is a part with.
  for (auto* list : {&command.commands, parent && parent != &program ? &parent->commands : nullptr})
    if (list)
      for (auto& x : *list)
        if (&x != &command)
          pages.push_back(man_page_name(x));
  std::string result;
  for (auto& x : pages)
    result += (result.empty() ? "" : ",\n") + reference(x);
  return result.empty() ? result : result + '\n';
}

} // namespace

std::string man_page_name(const Command& command) {
  return fmt::format("{}", fmt::join(command.path, "-"));
}

std::string man_page(const Command& command, const Command& program, const Edition& edition) {
  auto name = man_page_name(command);
  auto title = name;
  std::transform(title.begin(), title.end(), title.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  auto footer = read_footer(command.footer);
  auto description = prose(sentence(command.help)) + '\n';
  bool in_list = false;
  for (auto& x : footer.prose) {
    // "NAME      what it is": a list.
    if (auto gap = x.find("   "); gap != x.npos && x.find(' ') == gap) {
      description += ".TP\n" + bold(x.substr(0, gap)) + '\n' + prose(x.substr(gap)) + '\n';
      in_list = true;
      continue;
    }
    description += (in_list ? ".PP\n" : "") + prose(x) + '\n';
    in_list = false;
  }
  std::string options;
  for (auto* list : {&command.positionals, &command.options})
    for (auto& x : *list)
      options += entry(x);
  if (!command.inherited.empty()) {
    options +=
      ".PP\nOptions of the command that this is part of, which are understood here, too:\n";
    for (auto& x : command.inherited)
      options += entry(x);
  }
  std::string parts;
  for (auto& x : command.commands)
    parts += ".TP\n" + reference(man_page_name(x)) + '\n' + prose(sentence(x.help)) + '\n';
  std::string examples;
  for (auto& x : examples_of(command, program))
    examples +=
      std::string{examples.empty() ? "" : ".PP\n"} + ".nf\n.RS\n" + bold(x) + "\n.RE\n.fi\n";
  auto exit_status = footer.exit_status.empty() ? usual_exit_status : footer.exit_status;
  auto headline = command.help;
  // NAME is a line that is searched for: the first sentence, without its dot.
  headline = headline.substr(0, headline.find(": "));
  if (!headline.empty() && headline.back() == '.')
    headline.pop_back();
  return fmt::format(".TH {} 1 \"{}\" \"{} {}\" \"User Commands\"\n", roff(title, true),
                     edition.date, program.path.front(), edition.version) +
         section("NAME", roff(name, true) + " \\- " + roff(headline) + '\n') +
         section("SYNOPSIS", synopsis(command) + '\n') + section("DESCRIPTION", description) +
         section("COMMANDS", parts) + section("OPTIONS", options) +
         section("EXIT STATUS", prose(sentence(exit_status)) + '\n') +
         section("EXAMPLES", examples) + section("SEE ALSO", see_also(command, program));
}

} // namespace castor::cli
