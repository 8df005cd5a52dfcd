#include "castor/base/markup.hpp"
#include "castor/tools/chaos/chaos_report.hpp"
#include "castor/tools/chaos/chart.hpp"
#include "castor/tools/chaos/coverage.hpp"
#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace castor::faults {

namespace {

constexpr std::string_view styles = R"(
:root { color-scheme: light dark; --back: #fff; --text: #1c2430; --quiet: #66707d; --edge: #d9dee5;
  --good: #1a7f4b; --bad: #c62f2f; --fault: #d97706; --lasting: #f2c38a; --down: #e79a9a;
  --count: #4a7ab8; --c0: #2f6db3; --c1: #c2571a; --c2: #2c8a57; --c3: #8a4bb0; --c4: #a8861a;
  --c5: #b83a70; }
@media (prefers-color-scheme: dark) { :root { --back: #14181e; --text: #dfe5ec; --quiet: #93a0ae;
  --edge: #2f3843; --good: #57c68b; --bad: #ff7b72; --fault: #f5a742; --lasting: #7a5a2c;
  --down: #8a3f3f; --count: #6ea4e6; --c0: #6ea4e6; --c1: #f0925a; --c2: #63c794; --c3: #c295e6;
  --c4: #d9bd5c; --c5: #ee82ac; } }
body { background: var(--back); color: var(--text); font: 15px/1.5 system-ui, sans-serif;
  max-width: 1040px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.5em; } h2 { font-size: 1.15em; margin: 2em 0 .5em; }
.good { color: var(--good); } .bad { color: var(--bad); } .quiet { color: var(--quiet); }
table { border-collapse: collapse; width: 100%; }
td, th { text-align: left; vertical-align: top; padding: .2em 1em .2em 0;
  border-bottom: 1px solid var(--edge); }
th { color: var(--quiet); font-weight: normal; }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
pre, code { font: 13px/1.45 ui-monospace, monospace; }
pre { overflow-x: auto; border: 1px solid var(--edge); border-radius: 4px; padding: .7em; }
.violation { border-left: 4px solid var(--bad); padding-left: 1em; margin: 1em 0; }
svg { width: 100%; height: auto; } svg text { fill: var(--quiet); font-size: 12px; }
.grid { stroke: var(--edge); } .fault { fill: var(--fault); }
.undone { fill: none; stroke: var(--fault); } .lasting { fill: var(--lasting); }
.down { fill: var(--down); } .forever { fill: var(--bad); }
.up { stroke: var(--good); stroke-width: 2; } .works { fill: var(--good); }
.limit { stroke: var(--bad); stroke-dasharray: 4 3; } .count { fill: var(--count); }
.line { fill: none; stroke-width: 1.5; } .c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); }
.c2 { stroke: var(--c2); } .c3 { stroke: var(--c3); } .c4 { stroke: var(--c4); }
.c5 { stroke: var(--c5); } .legend svg { width: 1.2em; height: .8em; margin: 0 .3em 0 1em; }
)";

std::string when(Timestamp x) {
  return fmt::format("{:.3f} s", std::chrono::duration<double>(x).count());
}

std::string when(std::optional<Timestamp> x) {
  return x ? when(*x) : std::string{};
}

std::string heading(std::string_view text) {
  return fmt::format("<h2>{}</h2>\n", escaped(text));
}

/// A symbol of a chart, and what it stands for.
std::string legend_item(std::string_view symbol, std::string_view text) {
  return fmt::format("<svg viewBox=\"0 0 18 12\">{}</svg>{}", symbol, escaped(text));
}

class Table {
public:
  /// Columns whose names begin with a blank hold numbers.
  explicit Table(std::vector<std::string_view> columns) : columns_(std::move(columns)) {
    row_of("th", {columns_.begin(), columns_.end()});
  }

  /// @param cells plain text
  void row(const std::vector<std::string>& cells) { row_of("td", cells); }

  std::string take() { return "<table>\n" + text_ + "</table>\n"; }

private:
  void row_of(std::string_view tag, const std::vector<std::string>& cells) {
    text_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i)
      text_ +=
        fmt::format("<{0}{1}>{2}</{0}>", tag,
                    columns_[i].starts_with(' ') ? " class=\"number\"" : "", escaped(cells[i]));
    text_ += "</tr>\n";
  }

  std::vector<std::string_view> columns_;
  std::string text_;
};

std::string facts(const ChaosRun& run) {
  Table table{{"", ""}};
  table.row({"system", run.system});
  table.row({"again", run.command});
  table.row({"seed", std::to_string(run.seed)});
  table.row({"duration", rounded(run.duration)});
  table.row({"faults", fault_summary(run)});
  table.row({"outages", outage_summary(run) + "; " + recovery_summary(run)});
  if (run.activity)
    table.row({"meanwhile", activity_summary(*run.activity)});
  for (auto& [name, value] : run.facts)
    table.row({name, value});
  return table.take();
}

std::string checks(const ChaosRun& run) {
  std::string result = heading("What was checked") + "<table>\n";
  for (auto& x : run.checks) {
    auto held = x.verdict == CheckRecord::Verdict::held;
    auto violated = x.verdict == CheckRecord::Verdict::violated;
    result += fmt::format("<tr><td class=\"{}\">{}</td><td>{}</td><td>{}</td></tr>\n",
                          held       ? "good"
                          : violated ? "bad"
                                     : "quiet",
                          held       ? "held"
                          : violated ? "violated"
                                     : "undecided",
                          escaped(x.name), escaped(x.grounds));
  }
  return run.checks.empty() ? std::string{} : result + "</table>\n";
}

std::string violations(const ChaosRun& run) {
  std::string result;
  for (auto& x : run.violations)
    result += fmt::format("<div class=\"violation\"><strong class=\"bad\">{}</strong>{}\n"
                          "<pre>{}</pre>\n<p>seed {}, again: <code>{}</code></p></div>\n",
                          escaped(x.check), x.at ? " at " + when(*x.at) : "", escaped(x.text),
                          x.seed, escaped(x.replay));
  return result.empty() ? result : heading("Violations") + result;
}

std::string workload(const ChaosRun& run) {
  if (!run.workload)
    return {};
  Table table{{"statement", " due", " done", " answered", " apologised for", " late",
               " not answered", "last problem"}};
  for (auto& x : run.workload->statements)
    table.row({x.statement, std::to_string(x.counts.due), std::to_string(x.counts.done),
               std::to_string(x.counts.answered), std::to_string(x.counts.apologised),
               std::to_string(x.counts.late), std::to_string(x.counts.unanswered), x.problem});
  return heading("Workload") +
         fmt::format("<p>{}: {}</p>\n", escaped(run.workload->file),
                     escaped(summary_of(*run.workload))) +
         table.take();
}

std::string timeline(const ChaosRun& run) {
  if (run.faults.empty() && run.outages.empty())
    return {};
  auto legend =
    legend_item("<path d=\"M9 2l-5 9h10z\" class=\"fault\"/>", "fault") +
    legend_item("<path d=\"M9 2l-5 9h10z\" class=\"fault undone\"/>",
                "armed only, or not injected") +
    legend_item("<rect y=\"4\" width=\"18\" height=\"5\" class=\"lasting\"/>",
                "duration of a fault") +
    legend_item("<rect width=\"18\" height=\"12\" class=\"down\"/>", "down") +
    legend_item("<rect width=\"18\" height=\"12\" class=\"forever\"/>", "down, never back") +
    legend_item("<line x1=\"9\" y1=\"0\" x2=\"9\" y2=\"12\" class=\"up\"/>", "back") +
    legend_item("<circle cx=\"9\" cy=\"6\" r=\"4\" class=\"works\"/>", "first callback") +
    legend_item("<line x1=\"9\" y1=\"0\" x2=\"9\" y2=\"12\" class=\"limit\"/>", "violation");
  return heading("What happened when") + timeline_chart(run) + "<p class=\"quiet legend\">" +
         legend + "</p>\n";
}

std::string recovery(const ChaosRun& run) {
  auto chart = recovery_chart(run);
  return chart.empty() ? chart
                       : heading("How long it took until they worked again") + chart +
                           "<p class=\"quiet\">" + escaped(recovery_summary(run)) + "</p>\n";
}

std::string resources(const ChaosRun& run) {
  std::string result;
  auto add = [&](std::uint64_t ResourceSample::*value, double unit, std::string_view title) {
    auto chart = resource_chart(run, value, unit, title);
    if (!chart.empty())
      result += fmt::format("<p class=\"quiet\">{}</p>\n", escaped(title)) + chart;
  };
  add(&ResourceSample::memory, 1e6, "memory in MB");
  add(&ResourceSample::files, 1, "file descriptors");
  add(&ResourceSample::threads, 1, "threads");
  if (result.empty())
    return result;
  std::string legend;
  auto names = process_names(run);
  for (std::size_t i = 0; i < names.size(); ++i)
    legend += legend_item(
      fmt::format("<line y1=\"6\" x2=\"18\" y2=\"6\" class=\"line c{}\"/>", i % chart_colours),
      names[i]);
  return heading("Resources of the processes") + "<p class=\"quiet legend\">" + legend + "</p>\n" +
         result;
}

std::string fault_list(const ChaosRun& run) {
  Table table{{" at", "fault", "", " happened at", " until", "why not"}};
  for (auto& x : run.faults)
    table.row({when(x.at), x.fault, std::string{to_string(x.state)}, when(x.happened),
               when(x.until), x.outcome});
  return run.faults.empty() ? std::string{} : heading("Faults") + table.take();
}

std::string coverage(const ChaosRun& run) {
  auto all = coverage_of(run);
  if (all.empty())
    return {};
  auto result =
    heading("What was hit") +
    fmt::format("<p class=\"quiet\">{} of {} pairs of a fault and a target; faults that "
                "did not happen behind a minus</p>\n",
                all.hit(), all.possible());
  for (auto& x : all.tables()) {
    std::vector<std::string> titles;
    for (auto& kind : x.kinds)
      titles.push_back(' ' + kind);
    std::vector<std::string_view> columns{""};
    columns.insert(columns.end(), titles.begin(), titles.end());
    Table table{columns};
    for (auto& [target, cells] : x.rows) {
      std::vector<std::string> row{target};
      for (auto& cell : cells)
        row.push_back(to_text(cell));
      table.row(row);
    }
    result += table.take();
  }
  return result;
}

std::string outage_list(const ChaosRun& run) {
  Table table{
    {"who", " down at", " back after", " working after", " given up after", " bound", "why"}};
  for (auto& x : run.outages) {
    auto after = [&](std::optional<Timestamp> y) {
      return y ? rounded(*y - x.down) : std::string{};
    };
    table.row({x.target, when(x.down), after(x.up), after(x.first_callback), after(x.escalated),
               rounded(x.bound), x.reason});
  }
  return run.outages.empty() ? std::string{} : heading("Outages") + table.take();
}

std::string plan(const ChaosRun& run) {
  return run.plan.empty()
           ? std::string{}
           : heading("The plan, with all random choices made") + "<details><summary>" +
               "show</summary><pre>" + escaped(run.plan) + "</pre></details>\n";
}

} // namespace

std::string to_html(const ChaosRun& run) {
  return fmt::format("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width\">\n"
                     "<title>{0}: {1}</title>\n<style>{2}</style></head><body>\n"
                     "<h1>{0}: <span class=\"{3}\">{1}</span></h1>\n",
                     escaped(run.system), verdict_of(run), styles,
                     !run.held()             ? "bad"
                     : run.vacuous().empty() ? "good"
                                             : "quiet") +
         facts(run) + checks(run) + violations(run) + workload(run) + timeline(run) +
         recovery(run) + resources(run) + coverage(run) + fault_list(run) + outage_list(run) +
         plan(run) + "</body></html>\n";
}

} // namespace castor::faults
