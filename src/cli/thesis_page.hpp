// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// One page that stands by itself: the thesis's figures and tables of chapters 3 to 5 [yaacoub2008],
// made anew, beside what was printed. What is said of each stands in data/thesis_report.json.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace carpus::cli {

struct ThesisPage {
  /// By id ("figure_3_1", "table_4_1"): SVG or HTML to be set in as it is.
  std::map<std::string, std::string, std::less<>> shown;
  /// By id: in words, why there is none.
  std::map<std::string, std::string, std::less<>> missing;
  std::string about;  ///< HTML: which wrist, which machine
};

/// HTML without a reference to any other file. Every entry of the data is there: with its picture
/// or table, or with the reason why not.
[[nodiscard]] std::string thesis_page(const ThesisPage& page);

/// `<img>` with the file inside. @param type  "image/png".
[[nodiscard]] std::string embedded_image(std::string_view type, std::string_view content);

/// As text of HTML.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace carpus::cli
