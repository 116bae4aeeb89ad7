#include "compare/judge/report/page.hpp"
#include "compare/judge/report/report.hpp"

#include <algorithm>
#include <vector>

#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Returns the report of a stage with a mismatch, errors and a loose metric, and the report of a skipped stage.
std::vector<StageReport> two_reports() {
  StageReport wrong{Tally(Stage::closest_face)}, skipped{Tally(Stage::bound)};
  wrong.tally.begin({Stage::closest_face, "uniform", 1, 2, "", {}});
  wrong.tally.count(10, 10, 1, 4);
  for (const double error : {0.0, 0.25, 3.0}) wrong.tally.error(0, error, [] { return ""; });
  wrong.tally.error(1, 1e-3, [] { return ""; });
  wrong.tally.mismatch("feature: 1 <b> & more");
  wrong.seconds = 2;
  skipped.skipped = true;
  return {wrong, skipped};
}

}  // namespace

TEST_CASE("the page of a report is closed, loads nothing and escapes what it quotes", "[unit]") {
  const std::string page = report_page(two_reports(), "cpu against <reference>");
  for (const char* tag : {"html", "body", "table", "svg", "figure", "details", "h1", "h2"})
    REQUIRE(count(page, "<" + std::string(tag)) == count(page, "</" + std::string(tag) + ">"));
  for (const char* foreign : {"<script", "<link", "<img", "src="}) REQUIRE(count(page, foreign) == 0);
  REQUIRE(count(page, "cpu against &lt;reference&gt;") == 2);
  REQUIRE(count(page, "feature: 1 &lt;b&gt; &amp; more") == 1);
}

TEST_CASE(
    "the page has a row for each metric, a histogram for each that was measured, and marks what is wrong or loose",
    "[unit]") {
  const std::string page = report_page(two_reports(), "heading");
  const std::string table = page.substr(0, page.find("</table>"));
  REQUIRE(count(table, "<tr") == 1 + 3 + 1);
  REQUIRE(count(table, "class=\"wrong\"") == 3);
  REQUIRE(count(table, "class=\"loose\"") == 1);
  REQUIRE(count(page, "<svg ") == 2);
  REQUIRE(count(page, "stage=closest_face gen=uniform seed=1 index=2") >= 2);
  REQUIRE(count(table, "<td>0.4</td>") == 1);  // share of cases near a boundary
  REQUIRE(count(page, report_total(two_reports())) == 1);
}

TEST_CASE("the line over all stages shares out what lies near a boundary over the cases of all of them", "[unit]") {
  auto reports = two_reports();
  reports[1].tally.begin({Stage::bound, "soup", 1, 1, "", {}});
  reports[1].tally.count(30, 30, 0);
  REQUIRE(report_total(reports) ==
          "all stages: 40 cases, 1 mismatches, 10 % of all cases within 2^10 ulp of a decision boundary");
}
