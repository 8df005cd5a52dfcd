#include "castor/base/diagnostic.hpp"

#include "castor/base/diagnostic_log.hpp"
#include "castor/tests/actors/cast/support.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace castor::cast {

namespace {

SourceLine line_at(std::uint32_t order, std::string_view text = "text") {
  static const auto unit = std::make_shared<const SourceUnit>(SourceUnit{"a.cast", {}});
  return {text, unit, order + 1, order, SourceLine::Kind::text};
}

TEST(Rendering, ShowsPlaceChainLineAndRemedy) {
  test::World world{
    {{"parts/b.cast", "SETVAR kind=XX\nCPP %(kind) a A"}, {"a.cast", "\nINCLUDE parts/b.cast"}},
    {}};
  auto result = test::parse(test::system_with("INCLUDE a.cast"), world);
  ASSERT_EQ(result.diagnostics.size(), 1U);
  EXPECT_EQ(render(result.diagnostics[0]),
            "parts/b.cast:2: error: 'XX' is not a kind of component\n"
            "  included from a.cast:2\n"
            "  included from main.cast:5\n"
            "    CPP %(kind) a A\n"
            "  which expands to\n"
            "    CPP XX a A\n"
            "  remedy: write WM, TM, MG (managed) or UM (unmanaged) before the name: "
            "CPP MG name Class\n");
}

TEST(Rendering, LeavesOutWhatThereIsNot) {
  Diagnostic diagnostic{Severity::warning, SourceLocation("a.cast", 0), "", "", "message", ""};
  EXPECT_EQ(render(diagnostic), "a.cast: warning: message\n");
}

TEST(Rendering, ColoursBySeverity) {
  Diagnostic diagnostic{Severity::error, SourceLocation("a.cast", 1), "", "", "message", ""};
  auto error = render(diagnostic, true);
  diagnostic.severity = Severity::warning;
  EXPECT_NE(render(diagnostic, true).find("\x1b[1;35mwarning"), std::string::npos);
  diagnostic.severity = Severity::note;
  EXPECT_NE(error.find("\x1b[1;31merror"), std::string::npos);
  EXPECT_NE(render(diagnostic, true).find("\x1b[1;36mnote"), std::string::npos);
  EXPECT_EQ(render(diagnostic).find('\x1b'), std::string::npos);
}

TEST(Rendering, MakesControlCharactersVisible) {
  auto result = test::parse("non\x1b[2Jsense\x07 here");
  auto text = render(result.diagnostics);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_NE(text.find("non\\x1b[2Jsense\\x07 here"), std::string::npos);
}

TEST(Rendering, JoinsSeveral) {
  Diagnostic diagnostic{Severity::note, SourceLocation("a.cast", 1), "", "", "message", ""};
  EXPECT_EQ(render(std::vector<Diagnostic>{diagnostic, diagnostic}),
            "a.cast:1: note: message\na.cast:1: note: message\n");
}

TEST(Diagnostics, ShortenLongLines) {
  auto result = test::parse(std::string(100'000, 'x'));
  ASSERT_FALSE(result.diagnostics.empty());
  EXPECT_LT(render(result.diagnostics).size(), 2000U);
  EXPECT_TRUE(result.diagnostics[0].line.ends_with("..."));
}

TEST(DiagnosticLog, BringsFindingsIntoFileOrder) {
  DiagnosticLog log(10);
  log.report(Severity::error, line_at(5), "third");
  log.report(Severity::warning, line_at(2), "first");
  log.report(Severity::error, line_at(2), "second");
  log.report(Severity::error, SourceLocation("a.cast", 0), "before all");
  auto found = log.take();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].message, "before all");
  EXPECT_EQ(found[3].message, "third");
}

TEST(DiagnosticLog, KnowsWhetherThereAreErrors) {
  DiagnosticLog log(10);
  log.report(Severity::warning, line_at(1), "w");
  log.report(Severity::note, line_at(1), "n");
  EXPECT_FALSE(log.has_errors());
  log.report(Severity::error, line_at(1), "e");
  EXPECT_TRUE(log.has_errors());
}

TEST(DiagnosticLog, BoundsTheNumberAndSaysSo) {
  DiagnosticLog log(3);
  for (std::uint32_t i = 0; i < 10; ++i)
    log.report(Severity::error, line_at(i), std::to_string(i));
  EXPECT_FALSE(log.has_room(Severity::error));
  auto found = log.take();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[2].message, "2");
  EXPECT_EQ(found[3].severity, Severity::note);
  EXPECT_EQ(found[3].message, "7 more finding(s) are not listed");
}

TEST(DiagnosticLog, PrefersErrorsToWarnings) {
  DiagnosticLog log(3);
  for (std::uint32_t i = 0; i < 5; ++i)
    log.report(Severity::warning, line_at(i), "w" + std::to_string(i));
  log.report(Severity::error, line_at(9), "e");
  EXPECT_TRUE(log.has_room(Severity::error));
  auto found = log.take();
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].message, "w0");
  EXPECT_EQ(found[1].message, "w1");
  EXPECT_EQ(found[2].message, "e");
  EXPECT_EQ(found[3].message, "3 more finding(s) are not listed");
}

TEST(DiagnosticLog, WorksWithoutAnyRoom) {
  DiagnosticLog log(0);
  log.report(Severity::error, line_at(1), "e");
  EXPECT_TRUE(log.has_errors());
  ASSERT_EQ(log.take().size(), 1U);
}

TEST(DiagnosticLog, KeepsTheExpandedLineIfItDiffers) {
  DiagnosticLog log(3);
  log.report(Severity::error, line_at(1, "%(a)"), "e", {}, "b");
  log.report(Severity::error, line_at(2, "a"), "e", {}, "a");
  auto found = log.take();
  EXPECT_EQ(found[0].expanded, "b");
  EXPECT_EQ(found[1].expanded, "");
}

TEST(SourceLocations, CompareByContent) {
  EXPECT_EQ(SourceLocation("a", 1), SourceLocation("a", 1));
  EXPECT_FALSE(SourceLocation("a", 1) == SourceLocation("a", 2));
  EXPECT_FALSE(SourceLocation("a", 1) == SourceLocation("b", 1));
  auto included = std::make_shared<const SourceUnit>(SourceUnit{"a", SourceLocation("b", 2)});
  EXPECT_FALSE(SourceLocation("a", 1) == SourceLocation(included, 1));
  EXPECT_EQ(to_string(SourceLocation{}), "");
}

} // namespace

} // namespace castor::cast
