#include "castor/actors/cast/component_line.hpp"

#include "castor/actors/cast/arguments.hpp"
#include "castor/actors/cast/keywords.hpp"
#include "castor/actors/cast/scope.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <array>
#include <utility>

namespace castor::cast {

namespace {

/// A class that the Java toolkit has under another name.
struct Namesake {
  ComponentKind kind;
  std::string_view java_class;
  std::string_view cpp_class;
};

constexpr std::array namesakes{
  Namesake{ComponentKind::working_memory, "cast.architecture.SubarchitectureWorkingMemory",
           "SubarchitectureWorkingMemory"},
  Namesake{ComponentKind::task_manager, "cast.architecture.AlwaysPositiveTaskManager",
           "AlwaysPositiveTaskManager"},
};

/// The word that somebody who wrote C++ or Java was looking for; empty for any other word.
std::string_view intended_language(std::string_view word) {
  auto lower = lower_case(word.substr(0, 8));
  for (std::string_view spelling : {"cpp", "c++", "cxx", "cc", "c"})
    if (lower == spelling)
      return "CPP";
  if (lower == "java")
    return "JAVA";
  return lower == "python" ? "PYTHON" : std::string_view{};
}

bool is_name(std::string_view word) noexcept {
  return !word.empty() && !word.starts_with('#') && !word.starts_with('-');
}

class ComponentLineParser {
public:
  ComponentLineParser(WordStream& words, const StructureLine& line, const ComponentContext& context,
                      HostTable& hosts, DiagnosticLog& log)
    : words_(words), line_(line), context_(context), hosts_(hosts), log_(log) {
    // nop
  }

  ComponentLine run() {
    component_.where = line_.line->where();
    component_.line = line_.line->text;
    component_.subarchitecture = context_.subarchitecture;
    if (read_host_and_language() && read_kind() && read_name() && read_class()) {
      component_.options = parse_arguments(words_, line_, log_);
      if (is_correct_)
        result_.component = std::move(component_);
    }
    return std::move(result_);
  }

private:
  bool is_standalone() const noexcept { return context_.subarchitecture.empty(); }

  std::string shape() const {
    return is_standalone() ? "COMPONENT CPP name Class" : "CPP MG name Class";
  }

  bool read_host_and_language() {
    auto first = words_.next();
    if (!first)
      return fail("the line is incomplete", "write " + shape());
    if (auto language = match_language(*first)) {
      component_.language = *language;
      component_.host = context_.default_host;
      return true;
    }
    auto second = words_.next();
    auto language = second ? match_language(*second) : std::nullopt;
    if (!language)
      return explain_language(*first, second);
    component_.language = *language;
    component_.host = use_host(*first, line_, hosts_, log_);
    if (component_.host.empty())
      fail("the host is empty", "write the host, or nothing at all, before the language");
    return true;
  }

  bool explain_language(const std::string& first, const std::optional<std::string>& second) {
    for (const auto& word : {first, second.value_or("")})
      if (auto language = intended_language(word); !language.empty())
        return fail(in_quotes(word) + " is not a language", "write " + std::string(language));
    if (!is_standalone() && match_kind(first))
      return fail("the language is missing", "write CPP before it: CPP " + shorten(line_.text, 80));
    if (!second)
      return fail("the line is incomplete", "write " + shape());
    return fail(in_quotes(*second) + " is not a language, nor is " + in_quotes(first),
                "write " + shape() + ", with a host before CPP or without");
  }

  bool read_kind() {
    if (is_standalone()) {
      component_.kind = ComponentKind::standalone;
      result_.kind = component_.kind;
      return true;
    }
    auto word = words_.next();
    if (!word || word->starts_with('#'))
      return fail("the kind of component is missing", "write " + shape());
    auto kind = match_kind(*word);
    if (!kind) {
      std::string upper = *word;
      for (auto& c : upper)
        if (c >= 'a' && c <= 'z')
          c = static_cast<char>(c - 'a' + 'A');
      return fail(in_quotes(*word) + " is not a kind of component",
                  match_kind(upper)
                    ? "write " + upper
                    : "write WM, TM, MG (managed) or UM (unmanaged) before the name: " + shape());
    }
    component_.kind = *kind;
    result_.kind = kind;
    return true;
  }

  bool read_name() {
    if (component_.kind == ComponentKind::working_memory) {
      component_.name = working_memory_of(component_.subarchitecture);
      return true;
    }
    if (component_.kind == ComponentKind::task_manager) {
      component_.name = component_.subarchitecture + "_tm";
      return true;
    }
    auto word = words_.next();
    if (!word || !is_name(*word))
      return fail("the component's name and class are missing", "write " + shape());
    component_.name = std::move(*word);
    return true;
  }

  bool read_class() {
    auto word = words_.next();
    if (!word || !is_name(*word))
      return fail("the component's class is missing", class_remedy());
    component_.class_name = std::move(*word);
    if (component_.language != Language::cpp)
      find_namesake();
    return true;
  }

  void find_namesake() {
    for (const auto& namesake : namesakes) {
      if (component_.language == Language::java && component_.kind == namesake.kind &&
          component_.class_name == namesake.java_class) {
        component_.language = Language::cpp;
        component_.class_name = namesake.cpp_class;
        return;
      }
    }
    fail(std::string(to_string(component_.language)) + " component " +
           in_quotes(component_.class_name) + ": this runtime has C++ components only",
         class_remedy());
  }

  std::string class_remedy() const {
    // The class of a Java or Python component without its package: its C++ twin is called like
    // that.
    auto simple = component_.class_name.substr(component_.class_name.rfind('.') + 1);
    auto name_and_class =
      shorten(component_.name, 80) + " " + (simple.empty() ? "Class" : shorten(simple, 80));
    switch (component_.kind) {
      case ComponentKind::working_memory:
        return "write CPP WM SubarchitectureWorkingMemory";
      case ComponentKind::task_manager:
        return "write CPP TM AlwaysPositiveTaskManager";
      case ComponentKind::managed:
        return "write CPP MG " + name_and_class + ", with the name of a C++ class";
      case ComponentKind::unmanaged:
        return "write CPP UM " + name_and_class + ", with the name of a C++ class";
      case ComponentKind::standalone:
        break;
    }
    return "write COMPONENT CPP " + name_and_class + ", with the name of a C++ class";
  }

  bool fail(std::string message, std::string remedy) {
    is_correct_ = false;
    log_.report(Severity::error, *line_.line, std::move(message), std::move(remedy), line_.text);
    return false;
  }

  WordStream& words_;
  const StructureLine& line_;
  const ComponentContext& context_;
  HostTable& hosts_;
  DiagnosticLog& log_;
  ComponentDescription component_;
  ComponentLine result_;
  bool is_correct_ = true;
};

} // namespace

ComponentLine parse_component_line(WordStream& words, const StructureLine& line,
                                   const ComponentContext& context, HostTable& hosts,
                                   DiagnosticLog& log) {
  return ComponentLineParser(words, line, context, hosts, log).run();
}

std::string use_host(std::string_view expression, const StructureLine& line, HostTable& hosts,
                     DiagnosticLog& log) {
  auto resolved = hosts.use(expression);
  if (!resolved.defined)
    report_undefined_host(hosts, bracketed_host(expression), *line.line, log);
  return std::move(resolved.host);
}

bool looks_like_component(std::string_view text) noexcept {
  auto first = take_word(text);
  auto second = take_word(text);
  return match_language(first) || match_language(second) || match_kind(first) || match_kind(second);
}

} // namespace castor::cast
