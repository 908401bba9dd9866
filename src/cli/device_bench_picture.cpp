// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/device_bench_picture.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "device_bench/measures.hpp"
#include "drawing/svg.hpp"

namespace carpus::cli {
namespace {

using device_bench::Law;
using drawing::Anchor;
using drawing::line_from;
using drawing::text_at;

constexpr double kPanel = 300;
constexpr double kLeft = 70;
constexpr double kTop = 86;
constexpr double kGap = 62;
constexpr double kLeastMm = -10;
constexpr double kMostMm = 12;
constexpr double kLeastN = -2;
constexpr double kMostN = 4;
constexpr const char* kInColour = "#0b5fa5";
constexpr const char* kOutColour = "#c2571a";
constexpr const char* kGridColour = "#dddddd";
constexpr const char* kQuietColour = "#666666";

struct Panel {
  double x = 0;
  double y = 0;
  [[nodiscard]] double at_mm(double mm) const {
    return x + kPanel * (std::clamp(mm, kLeastMm, kMostMm) - kLeastMm) / (kMostMm - kLeastMm);
  }
  [[nodiscard]] double at_n(double n) const {
    return y + kPanel * (kMostN - std::clamp(n, kLeastN, kMostN)) / (kMostN - kLeastN);
  }
};

std::string number(double value) { return std::to_string(static_cast<int>(std::lround(value))); }

std::string axes(const Panel& panel, const std::string& title, const std::string& what) {
  std::string body = text_at(panel.x, panel.y - 26, title, {.size = 15, .is_bold = true});
  body += text_at(panel.x, panel.y - 9, what, {.colour = kQuietColour, .size = 12});
  for (double mm = kLeastMm; mm <= kMostMm; mm += 2) {
    const double x = panel.at_mm(mm);
    body += line_from(x, panel.y, x, panel.y + kPanel, mm == 0 ? "#222222" : kGridColour,
                      mm == 0 ? 1.5 : 1);
    if (std::fmod(mm, 4) == 0) {
      body += text_at(x, panel.y + kPanel + 16, number(mm), {.anchor = Anchor::Middle, .size = 11});
    }
  }
  for (double n = kLeastN; n <= kMostN; n += 1) {
    const double y = panel.at_n(n);
    body += line_from(panel.x, y, panel.x + kPanel, y, n == 0 ? "#999999" : kGridColour);
    body += text_at(panel.x - 7, y + 4, number(n), {.anchor = Anchor::End, .size = 11});
  }
  body += text_at(panel.x + kPanel / 2, panel.y + kPanel + 33, "depth of the tip in the wall, mm",
                  {.anchor = Anchor::Middle, .size = 12});
  return body;
}

/// Until the hand means to come back, then after.
std::string curves(const Panel& panel, const std::vector<device_bench::Sample>& samples) {
  const auto turn =
      std::max_element(samples.begin(), samples.end(),
                       [](const auto& a, const auto& b) { return a.intent_mm < b.intent_mm; });
  const double deepest = turn->intent_mm;
  std::size_t last_deep = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].intent_mm > deepest - 1e-9) last_deep = i;
  }
  std::string in;
  std::string out;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Vec2 from{panel.at_mm(samples[i - 1].depth_mm), panel.at_n(samples[i - 1].force_n)};
    const Vec2 to{panel.at_mm(samples[i].depth_mm), panel.at_n(samples[i].force_n)};
    (i <= last_deep ? in : out) += drawing::line_path(from, to);
  }
  return drawing::strokes(out, {kOutColour, 2, 0.9}) + drawing::strokes(in, {kInColour, 2, 0.9});
}

}  // namespace

std::string device_bench_picture(const device_bench::BoardMaker& board) {
  std::string body = text_at(kLeft, 34, "What a pen grip feels of a wall that it touches with 2 N",
                             {.size = 20, .is_bold = true});
  struct What {
    Law law;
    firmware::Drive drive;
    const char* title;
    const char* what;
  };
  constexpr What kWhats[] = {
      {Law::Thesis, firmware::Drive::Stop, "The thesis's arm as it was",
       "servos off in free space, holding at collision"},
      {Law::Ours, firmware::Drive::Stop, "Ours, drive A", "servos as programmable stops"},
      {Law::Thesis, firmware::Drive::Motor, "The thesis's law on drive B",
       "a spring of 2 N/mm each 20 ms"},
      {Law::Ours, firmware::Drive::Motor, "Ours, drive B", "a plane of 2 N/mm at 4 kHz"},
  };
  for (int i = 0; i < 4; ++i) {
    const What& what = kWhats[i];
    const Panel panel{kLeft + (i % 2) * (kPanel + kGap),
                      kTop + 20 + (i / 2) * (kPanel + kGap + 44)};
    device_bench::RigOptions options;
    options.law = what.law;
    options.drive = what.drive;
    options.board = board;
    const auto rig = device_bench::make_rig(options);
    body += axes(panel, what.title, what.what);
    body += curves(panel, device_bench::touch(*rig));
  }
  const double below = kTop + 20 + 2 * (kPanel + kGap + 44) + 2;
  body += line_from(kLeft, below - 4, kLeft + 26, below - 4, kInColour, 3);
  body += text_at(kLeft + 34, below, "going in and staying");
  body += line_from(kLeft + 190, below - 4, kLeft + 216, below - 4, kOutColour, 3);
  body += text_at(kLeft + 224, below, "coming out");
  body += text_at(kLeft + 330, below, "force out of the wall, N; below 0 the arm holds the hand");
  body += text_at(kLeft, below + 22,
                  "Simulated arms and hands. A true wall is the black line: no force before it, no "
                  "way past it. Beyond the frame: at its edge.",
                  {.colour = kQuietColour});
  return drawing::page(2 * kLeft + 2 * kPanel + kGap, below + 44, body);
}

}  // namespace carpus::cli
