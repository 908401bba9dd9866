// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/thesis_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/thesis_tables.hpp"
#include "core/error.hpp"

namespace carpus::cli {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

TEST(ThesisPage, HoldsEveryFigureAndTableOfTheThreeChapters) {
  const std::string html = thesis_page({});
  for (const auto& [chapter, figures] : {std::pair{3, 11}, {4, 8}, {5, 3}}) {
    for (int i = 1; i <= figures; ++i) {
      const std::string name = std::to_string(chapter) + "." + std::to_string(i);
      EXPECT_THAT(html, HasSubstr("Figure " + name + ":"));
    }
  }
  for (const char* table : {"Table 4.1:", "Table 4.2:", "Table 5.1:"}) {
    EXPECT_THAT(html, HasSubstr(table));
  }
  EXPECT_THAT(html, Not(HasSubstr("src=\"http")));
}

TEST(ThesisPage, ShowsWhatThereIsAndSaysWhyTheRestIsNot) {
  ThesisPage page;
  page.shown["figure_3_1"] = embedded_image("image/png", std::string("\0\xff\x10", 3));
  page.missing["table_4_1"] = "no <peer>";
  const std::string html = thesis_page(page);
  EXPECT_THAT(html, HasSubstr("src=\"data:image/png;base64,AP8Q\""));
  EXPECT_THAT(html, HasSubstr("no &lt;peer&gt;"));
}

Json bench_of(std::initializer_list<Json> rows) {
  return {{"machine", "M"},
          {"compiler", "C"},
          {"bones", ""},
          {"thesis",
           {{{"case", "Ulna"},
             {"n", 977},
             {"surface_facets", 1864},
             {"h", 312},
             {"hull_facets", 620},
             {"hybrid_over",
              {{"gift_wrapping", {{"here", 0.9}, {"thesis", 0.5365}}},
               {"quickhull", {{"here", nullptr}, {"thesis", 0.5945}}},
               {"chan", {{"here", 2.5}, {"thesis", 0.6875}}}}}}}},
          {"rows", rows}};
}

Json row(const char* name, int n, const char* engine, const Json& seconds, bool agrees = true) {
  return {{"case", name},
          {"n", n},
          {"h", 300},
          {"engine", engine},
          {"surface_facets", nullptr},
          {"seconds", seconds},
          {"agrees", agrees},
          {"thesis_seconds", 0.22}};
}

TEST(ThesisTables, PutPrintedBesideMeasuredAndBoundBruteForceByItsGrowth) {
  const Json bench =
      bench_of({row("Ulna", 977, "hybrid", 0.004), row("Ulna", 977, "chan", 2e-6, false),
                row("Ulna", 977, "brute_force", nullptr), row("Part", 10, "brute_force", 1e-3),
                row("Part, larger", 100, "brute_force", 1.0)});
  const std::string html = hull_table_html(bench);
  EXPECT_THAT(html, HasSubstr("<td class=\"printed\">977</td><td>977</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"printed\">620</td><td>596</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"printed\">0.22 s</td><td>4 ms</td>"));
  EXPECT_THAT(html, HasSubstr("<td>2 µs !</td>")) << "another answer is marked";
  EXPECT_THAT(html, HasSubstr("≈ 932.6 s (not run)"));  // 1e-3 (977 / 10)^3
  EXPECT_THAT(html, HasSubstr("n<sup>3.0</sup>"));
  EXPECT_THROW((void)hull_table_html(Json::object()), InvalidInput);
}

TEST(ThesisTables, APowerIsFoundAgain) {
  const PowerLaw law = fit_power({{10, 2e2}, {20, 2e2 * 16}, {40, 2e2 * 256}});
  EXPECT_NEAR(law.exponent, 4, 1e-12);
  EXPECT_NEAR(law.factor, 0.02, 1e-12);
  EXPECT_EQ(fit_power({{10, 1}}).exponent, 0);
}

TEST(ThesisTables, CollisionTakesTheColdRows) {
  const auto one = [](const char* name, const char* engine, double seconds, Json printed) {
    Json r{{"case", name},    {"engine", engine},   {"vertices", 977},
           {"facets", 596.0}, {"seconds", seconds}, {"agrees", true}};
    if (!printed.is_null()) r["thesis_seconds"] = printed;
    return r;
  };
  const Json bench{
      {"machine", "M"},
      {"compiler", "C"},
      {"bones", "b"},
      {"rows",
       {one("Ulna", "lp_scan", 4e-6, 0.0563), one("Ulna", "ivri_all_vertices", 8e-6, 0.0753),
        one("Ulna", "lp_growth", 4e-7, nullptr), one("Ulna warm", "lp_scan", 1e-6, 0.0563)}}};
  const std::string html = collision_table_html(bench);
  EXPECT_THAT(html, HasSubstr("<td class=\"printed\">0.0563 s</td><td>4 µs</td>"));
  EXPECT_THAT(html, HasSubstr("<td class=\"printed\">0.75</td><td>0.50</td>"));
  EXPECT_THAT(html, HasSubstr("lp_growth, 0.4 µs"));
  EXPECT_THAT(html, Not(HasSubstr("warm")));
  EXPECT_THROW((void)collision_table_html(Json{{"rows", 3}}), InvalidInput);
}

}  // namespace
}  // namespace carpus::cli
