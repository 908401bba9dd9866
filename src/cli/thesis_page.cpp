// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/thesis_page.hpp"

#include <openssl/evp.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace carpus::data {
std::string_view thesis_report();
}

namespace carpus::cli {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kStyle = R"(
  body { font: 15px/1.5 "DejaVu Sans", Arial, sans-serif; color: #1c1c1c; max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
  h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { margin-top: 2.6rem; border-bottom: 1px solid #bbb; }
  h3 { font-size: 1rem; margin: 1.8rem 0 .4rem; } p.note { margin: .3rem 0; } .about { color: #444; }
  section { break-inside: avoid; } section.long { break-inside: auto; }
  .shown { background: #fff; border: 1px solid #ddd; padding: .4rem; overflow-x: auto; text-align: center; }
  .shown svg, .shown img { max-width: 100%; max-height: 40rem; height: auto; }
  table { border-collapse: collapse; font-size: .78rem; margin: 0 auto .8rem; } caption { text-align: left; padding: .3rem 0; }
  th, td { padding: .15rem .45rem; text-align: right; border-bottom: 1px solid #e3e3e3; white-space: nowrap; }
  th:first-child, td:first-child { text-align: left; } th { vertical-align: bottom; white-space: normal; }
  td.printed { color: #8a4b00; } .missing { color: #8a1c1c; } code { background: #f3f1ea; padding: 0 .25rem; }
  nav a { margin-right: .8rem; } @media print { body { margin: 0; font-size: 10pt; } nav { display: none; } table { font-size: 6.8pt; } .shown { overflow: visible; } .shown svg, .shown img { max-height: 17cm; } }
)";

std::string text_of(const Json& json, const char* key) {
  return escaped(json.at(key).get<std::string>());
}

std::string entry_html(const Json& entry, const ThesisPage& page) {
  const auto id = entry.at("id").get<std::string>();
  const bool is_table = id.starts_with("table");
  std::string html = "<section id=\"" + id + "\"" + (is_table ? " class=\"long\"" : "") +
                     ">\n<h3>" + text_of(entry, "printed") + "</h3>\n";
  if (const auto found = page.shown.find(id); found != page.shown.end()) {
    html += "<div class=\"shown\">" + found->second + "</div>\n";
    html += "<p class=\"note\"><b>Made by</b> <code>" + text_of(entry, "made_by") + "</code></p>\n";
  } else if (const auto why = page.missing.find(id); why != page.missing.end()) {
    html += "<p class=\"note missing\">Not made in this run: " + escaped(why->second) + "</p>\n";
  }
  return html + "<p class=\"note\"><b>Beside the printed one.</b> " + text_of(entry, "differs") +
         "</p>\n</section>\n";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      default:
        html += c;
    }
  }
  return html;
}

std::string embedded_image(std::string_view type, std::string_view content) {
  std::vector<unsigned char> letters(4 * ((content.size() + 2) / 3) + 1);
  EVP_EncodeBlock(letters.data(), reinterpret_cast<const unsigned char*>(content.data()),
                  static_cast<int>(content.size()));
  return "<img alt=\"\" src=\"data:" + std::string(type) + ";base64," +
         std::string(letters.begin(), letters.end() - 1) + "\">";
}

std::string thesis_page(const ThesisPage& page) {
  const Json data = Json::parse(data::thesis_report());
  std::string html =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
      text_of(data, "title") + "</title>\n<style>" + std::string(kStyle) +
      "</style>\n</head>\n<body>\n<h1>" + text_of(data, "title") + "</h1>\n<p class=\"about\">" +
      text_of(data, "source") + "</p>\n" + page.about + "<nav>";
  for (const Json& chapter : data.at("chapters")) {
    const std::string number = std::to_string(chapter.at("number").get<int>());
    html.append("<a href=\"#chapter_").append(number).append("\">Chapter ").append(number);
    html += "</a>";
  }
  html += "</nav>\n";
  for (const Json& chapter : data.at("chapters")) {
    const std::string number = std::to_string(chapter.at("number").get<int>());
    html.append("<h2 id=\"chapter_").append(number).append("\">").append(number).append(" ");
    html += text_of(chapter, "title") + "</h2>\n";
    for (const Json& entry : chapter.at("entries")) html += entry_html(entry, page);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace carpus::cli
