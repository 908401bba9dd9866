// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// 1. Triangles go into a buffer of depth, normal and piece, twice as fine as the picture; and seen
//    from the light, into one of depth alone: the shadow.
// 2. Each sample is lit: sky, lamp less shadow, less what its surroundings hide.
// 3. Ink where piece, depth or normal jump; then averaged, four to one.
// 4. Numbers; then the most frequent colours become the palette.
#include "hardware/workshop/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "case_io/png.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "geometry/aabb.hpp"

namespace carpus::hardware {
namespace {

using Colour = Vec3;  // red, green, blue: 0 to 1

constexpr int kFiner = 2;
constexpr Colour kPaper{0.957, 0.965, 0.973};
constexpr Colour kInk{0.13, 0.16, 0.20};
constexpr Colour kCallout{0.80, 0.20, 0.12};
constexpr int kGround = -2;
constexpr int kNothing = -1;

Colour colour_of(Material material) {
  switch (material) {
    case Material::Frame:
      return {0.33, 0.38, 0.44};
    case Material::Moving:
      return {0.94, 0.93, 0.90};
    case Material::Accent:
      return {0.05, 0.55, 0.58};
    case Material::Drive:
      return {0.96, 0.63, 0.20};
    case Material::Steel:
      return {0.72, 0.75, 0.78};
    case Material::Carbon:
      return {0.20, 0.21, 0.23};
    case Material::Servo:
      return {0.17, 0.18, 0.21};
    case Material::Brass:
      return {0.78, 0.62, 0.30};
    case Material::Board:
      return {0.10, 0.42, 0.30};
    case Material::Wood:
      return {0.86, 0.76, 0.60};
    case Material::Rubber:
      return {0.76, 0.42, 0.40};
    case Material::Red:
      return {0.82, 0.14, 0.12};
  }
  return {};
}

struct Sample {
  double depth = std::numeric_limits<double>::infinity();
  int piece = kNothing;
  Vec3 normal;
  Vec3 point;
};

/// Maps a point to x, y of the picture and depth.
struct View {
  Mat3 axes;  ///< rows: right, down, away
  Vec3 eye;
  double scale = 1;
  bool is_perspective = true;
  double centre_x = 0;
  double centre_y = 0;

  [[nodiscard]] Vec3 operator()(const Vec3& p) const {
    const Vec3 v = axes * (p - eye);
    const double s = is_perspective ? scale / v.z : scale;
    return {centre_x + v.x * s, centre_y + v.y * s, v.z};
  }
};

class Buffer {
 public:
  Buffer(int width, int height)
      : width_(width),
        height_(height),
        samples_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] Sample& at(int x, int y) {
    return samples_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                    static_cast<std::size_t>(x)];
  }

  void fill(const View& view, const std::array<Vec3, 3>& corners, int piece) {
    const Vec3 n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    const Vec3 normal = normalized_or(n, {0, 0, 1});
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = view(corners[i]);
    const double area =
        (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (!(std::abs(area) > 1e-9)) return;
    const int x0 = std::max(0, static_cast<int>(std::floor(std::min({p[0].x, p[1].x, p[2].x}))));
    const int x1 =
        std::min(width_ - 1, static_cast<int>(std::ceil(std::max({p[0].x, p[1].x, p[2].x}))));
    const int y0 = std::max(0, static_cast<int>(std::floor(std::min({p[0].y, p[1].y, p[2].y}))));
    const int y1 =
        std::min(height_ - 1, static_cast<int>(std::ceil(std::max({p[0].y, p[1].y, p[2].y}))));
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        const double u = x + 0.5;
        const double v = y + 0.5;
        const double a = ((p[1].x - u) * (p[2].y - v) - (p[2].x - u) * (p[1].y - v)) / area;
        const double b = ((p[2].x - u) * (p[0].y - v) - (p[0].x - u) * (p[2].y - v)) / area;
        const double c = 1 - a - b;
        if (!(a >= 0 && b >= 0 && c >= 0)) continue;
        const double depth = view.is_perspective ? 1 / (a / p[0].z + b / p[1].z + c / p[2].z)
                                                 : a * p[0].z + b * p[1].z + c * p[2].z;
        Sample& sample = at(x, y);
        if (!(depth < sample.depth)) continue;
        const double wa = view.is_perspective ? a * depth / p[0].z : a;
        const double wb = view.is_perspective ? b * depth / p[1].z : b;
        sample = {depth, piece, normal,
                  corners[0] * wa + corners[1] * wb + corners[2] * (1 - wa - wb)};
      }
    }
  }

 private:
  int width_;
  int height_;
  std::vector<Sample> samples_;
};

Mat3 looking_along(const Vec3& away) {
  const Vec3 right = normalized_or(cross(away, {0, 0, 1}), {1, 0, 0});
  return {{right, cross(away, right), away}};
}

class Drawing {
 public:
  Drawing(std::span<const Drawn> drawn, const Camera& camera)
      : drawn_(drawn),
        camera_(camera),
        buffer_(camera.width * kFiner, camera.height * kFiner),
        light_(1400, 1400) {
    for (const Drawn& d : drawn_) {
      for (const Vec3& p : d.piece->mesh.vertices) bounds_.include(p + d.shift);
    }
    aim();
    fill();
  }

  /// The sample of a piece that is nearest to the middle of all that is seen of it, in pixels.
  [[nodiscard]] Vec3 middle_of(std::size_t drawn) {
    Vec3 sum;
    double count = 0;
    const auto each = [&](auto visit) {
      for (int y = 0; y < buffer_.height(); ++y) {
        for (int x = 0; x < buffer_.width(); ++x) {
          if (buffer_.at(x, y).piece == static_cast<int>(drawn)) {
            visit(Vec3{static_cast<double>(x), static_cast<double>(y), 0});
          }
        }
      }
    };
    each([&](const Vec3& p) {
      sum += p;
      ++count;
    });
    if (!(count > 0)) {
      throw InvalidInput("picture: nothing is seen of " + drawn_[drawn].piece->name);
    }
    const Vec3 middle = sum / count;
    Vec3 best{-1e9, -1e9, 0};
    each([&](const Vec3& p) {
      if (distance(p, middle) < distance(best, middle)) best = p;
    });
    return best / kFiner;
  }

  /// The picture, red, green and blue, averaged.
  [[nodiscard]] std::vector<Colour> colours() {
    const int w = buffer_.width();
    const int h = buffer_.height();
    std::vector<Colour> picture(static_cast<std::size_t>(camera_.width) *
                                static_cast<std::size_t>(camera_.height));
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) {
        const double ink = ink_at(x, y);
        const Colour colour = lit(x, y) * (1 - ink) + kInk * ink;
        picture[static_cast<std::size_t>(y / kFiner) * static_cast<std::size_t>(camera_.width) +
                static_cast<std::size_t>(x / kFiner)] += colour / (kFiner * kFiner);
      }
    }
    return picture;
  }

 private:
  void aim() {
    const double around = radians_from_degrees(camera_.around_deg);
    const double above = radians_from_degrees(camera_.above_deg);
    const Vec3 towards{std::cos(around) * std::cos(above), std::sin(around) * std::cos(above),
                       std::sin(above)};
    const Vec3 middle = bounds_.centre() + camera_.shift;
    const double radius = length(bounds_.extent()) / 2;
    const double away = radius * 4.5;
    view_.axes = looking_along(-towards);
    view_.eye = middle + towards * away;
    view_.scale = 1;
    view_.centre_x = buffer_.width() / 2.0;
    view_.centre_y = buffer_.height() / 2.0;
    // In the middle, and as large as all corners of all pieces allow.
    Aabb seen;
    for (const Drawn& d : drawn_) {
      for (const Vec3& p : d.piece->mesh.vertices) seen.include(view_(p + d.shift));
    }
    const Vec3 size = seen.extent();
    const double middle_x = seen.centre().x - view_.centre_x;
    const double middle_y = seen.centre().y - view_.centre_y;
    view_.scale =
        camera_.zoom * std::min(0.92 * buffer_.width() / size.x, 0.92 * buffer_.height() / size.y);
    view_.centre_x -= middle_x * view_.scale;
    view_.centre_y -= middle_y * view_.scale;
    // The lamp stands behind the viewer's left shoulder.
    const Vec3 lamp =
        normalized_or(towards * 0.6 + view_.axes.rows[0] * -0.55 + Vec3{0, 0, 1.1}, {0, 0, 1});
    light_view_.axes = looking_along(-lamp);
    light_view_.is_perspective = false;
    light_view_.eye = bounds_.centre();
    light_view_.scale = 1400 / (radius * 2.6);
    light_view_.centre_x = light_view_.centre_y = 700;
    lamp_ = lamp;
  }

  void fill() {
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      const Drawn& d = drawn_[i];
      for (const Triangle& f : d.piece->mesh.facets) {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = d.piece->mesh.vertices[f[k]] + d.shift;
        buffer_.fill(view_, corners, static_cast<int>(i));
        light_.fill(light_view_, corners, static_cast<int>(i));
      }
    }
    const double z = bounds_.low.z - 0.3;
    const double r = length(bounds_.extent()) * 1.2;
    const Vec3 c = bounds_.centre();
    const std::array<Vec3, 4> ground{Vec3{c.x - r, c.y - r, z}, Vec3{c.x + r, c.y - r, z},
                                     Vec3{c.x + r, c.y + r, z}, Vec3{c.x - r, c.y + r, z}};
    buffer_.fill(view_, {ground[0], ground[1], ground[2]}, kGround);
    buffer_.fill(view_, {ground[0], ground[2], ground[3]}, kGround);
  }

  /// Share of the lamp's light that arrives: four samples, so that the shadow's edge is soft.
  [[nodiscard]] double lamp_at(const Vec3& point, const Vec3& normal) {
    const double step = 1.6 / light_view_.scale;
    const Vec3 p = light_view_(point + normal * (1.5 * step) + lamp_ * step);
    int free = 0;
    for (const auto& [dx, dy] : {std::pair{-0.8, -0.8}, {0.8, -0.8}, {-0.8, 0.8}, {0.8, 0.8}}) {
      const int x = static_cast<int>(p.x + dx);
      const int y = static_cast<int>(p.y + dy);
      if (x < 0 || y < 0 || x >= light_.width() || y >= light_.height() ||
          light_.at(x, y).depth > p.z - step)
        ++free;
    }
    return free / 4.0;
  }

  /// Share of the surroundings that is open: nearer neighbours in the picture hide it.
  [[nodiscard]] double open_at(int x, int y) {
    const Sample& here = buffer_.at(x, y);
    const double reach = length(bounds_.extent()) * 0.03;
    const double pixels = std::max(3.0, reach * view_.scale / here.depth);
    double hidden = 0;
    for (int i = 0; i < 12; ++i) {
      const double turn = i * 2.399963;
      const double far = pixels * std::sqrt((i + 0.5) / 12);
      const int u = std::clamp(x + static_cast<int>(far * std::cos(turn)), 0, buffer_.width() - 1);
      const int v = std::clamp(y + static_cast<int>(far * std::sin(turn)), 0, buffer_.height() - 1);
      const Sample& other = buffer_.at(u, v);
      if (other.piece == kNothing) continue;
      const Vec3 to = other.point - here.point;
      const double away = length(to);
      if (away > 1e-6 && away < 2 * reach)
        hidden += std::max(0.0, dot(to, here.normal) / away - 0.1);
    }
    return 1 - std::min(0.6, 1.1 * hidden / 12);
  }

  [[nodiscard]] Colour lit(int x, int y) {
    const Sample& sample = buffer_.at(x, y);
    if (sample.piece == kNothing) return kPaper;
    if (sample.piece == kGround)
      return kPaper * (0.84 + 0.16 * lamp_at(sample.point, sample.normal));
    const Drawn& d = drawn_[static_cast<std::size_t>(sample.piece)];
    Colour base = colour_of(d.piece->material);
    if (d.is_pale) {
      const double grey = 0.3 * base.x + 0.5 * base.y + 0.2 * base.z;
      base = Colour{grey, grey, grey} * 0.16 + Colour{0.76, 0.78, 0.80} * 0.84;
    }
    const Vec3 n = dot(sample.normal, view_.axes.rows[2]) > 0 ? -sample.normal : sample.normal;
    const double lamp = std::max(0.0, dot(n, lamp_)) * lamp_at(sample.point, n);
    const double light = (0.52 + 0.16 * n.z) * open_at(x, y) + 0.50 * lamp;
    const auto toned = [&](double c) { return std::clamp(c * light, 0.0, 1.0); };
    return {toned(base.x), toned(base.y), toned(base.z)};
  }

  [[nodiscard]] double ink_at(int x, int y) {
    const Sample& here = buffer_.at(x, y);
    double most = 0;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 0}, {0, -1}}) {
      const int u = x + dx;
      const int v = y + dy;
      if (u < 0 || v < 0 || u >= buffer_.width() || v >= buffer_.height()) continue;
      const Sample& other = buffer_.at(u, v);
      const bool is_paper = here.piece < 0;
      if (is_paper && other.piece < 0) continue;
      const bool is_pale = here.piece >= 0 && drawn_[static_cast<std::size_t>(here.piece)].is_pale;
      const double weight = is_pale ? 0.45 : 1;
      if (here.piece != other.piece) {
        // On the nearer side alone, so that a line is as wide everywhere.
        if (here.piece >= 0 && (other.piece < 0 || here.depth < other.depth))
          most = std::max(most, 0.85 * weight);
      } else if (dot(here.normal, other.normal) < 0.82) {
        most = std::max(most, 0.55 * weight);
      } else if (std::abs(dot(other.point - here.point, here.normal)) >
                 length(bounds_.extent()) * 0.004) {
        if (here.depth < other.depth) most = std::max(most, 0.7 * weight);
      }
    }
    return most;
  }

  std::span<const Drawn> drawn_;
  Camera camera_;
  Buffer buffer_;
  Buffer light_;
  Aabb bounds_;
  View view_;
  View light_view_;
  Vec3 lamp_;
};

/// Digits of 5 x 7, a row a number of five bits.
constexpr std::array<std::array<std::uint8_t, 7>, 10> kDigits{{{14, 17, 19, 21, 25, 17, 14},
                                                               {4, 12, 4, 4, 4, 4, 14},
                                                               {14, 17, 1, 2, 4, 8, 31},
                                                               {31, 2, 4, 2, 1, 17, 14},
                                                               {2, 6, 10, 18, 31, 2, 2},
                                                               {31, 16, 30, 1, 1, 17, 14},
                                                               {6, 8, 16, 30, 17, 17, 14},
                                                               {31, 1, 2, 4, 8, 8, 8},
                                                               {14, 17, 17, 14, 17, 17, 14},
                                                               {14, 17, 17, 15, 1, 2, 12}}};

class Numbering {
 public:
  Numbering(std::vector<Colour>& picture, const Camera& camera)
      : picture_(picture), camera_(camera) {}

  void draw(std::span<const Callout> callouts, Drawing& drawing) {
    struct Label {
      double x, y, to_x, to_y;
      int number;
    };
    std::vector<Label> labels;
    for (const Callout& callout : callouts) {
      const Vec3 p = drawing.middle_of(callout.drawn);
      const double dx = p.x - camera_.width / 2.0;
      const double dy = p.y - camera_.height / 2.0;
      const double far = std::max(1.0, std::hypot(dx, dy));
      labels.push_back({p.x + dx / far * 75, p.y + dy / far * 75, p.x, p.y, callout.number});
    }
    // Apart from each other, and inside.
    for (int round = 0; round < 200; ++round) {
      for (std::size_t i = 0; i < labels.size(); ++i) {
        for (std::size_t k = 0; k < labels.size(); ++k) {
          const double dx = labels[i].x - labels[k].x;
          const double dy = labels[i].y - labels[k].y;
          const double far = std::hypot(dx, dy);
          if (i == k || far > 40) continue;
          labels[i].x += far > 0 ? dx / far * 2 : (i < k ? -2 : 2);
          labels[i].y += far > 0 ? dy / far * 2 : 1;
        }
        labels[i].x = std::clamp(labels[i].x, 22.0, camera_.width - 22.0);
        labels[i].y = std::clamp(labels[i].y, 22.0, camera_.height - 22.0);
      }
    }
    for (const Label& l : labels) {
      line(l.x, l.y, l.to_x, l.to_y);
      disc(l.to_x, l.to_y, 3.5, kCallout);
    }
    for (const Label& l : labels) {
      disc(l.x, l.y, 16, kCallout);
      disc(l.x, l.y, 14.2, {1, 1, 1});
      write(l.x, l.y, l.number);
    }
  }

 private:
  void mix(int x, int y, const Colour& colour, double share) {
    if (x < 0 || y < 0 || x >= camera_.width || y >= camera_.height) return;
    Colour& c = picture_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) +
                         static_cast<std::size_t>(x)];
    c = c * (1 - share) + colour * share;
  }
  void disc(double x, double y, double radius, const Colour& colour) {
    for (int v = static_cast<int>(y - radius) - 1; v <= y + radius + 1; ++v) {
      for (int u = static_cast<int>(x - radius) - 1; u <= x + radius + 1; ++u)
        mix(u, v, colour,
            std::clamp(radius + 0.5 - std::hypot(u + 0.5 - x, v + 0.5 - y), 0.0, 1.0));
    }
  }
  void line(double x0, double y0, double x1, double y1) {
    const double dx = x1 - x0;
    const double dy = y1 - y0;
    const double far = std::max(1.0, std::hypot(dx, dy));
    for (int v = static_cast<int>(std::min(y0, y1)) - 2; v <= std::max(y0, y1) + 2; ++v) {
      for (int u = static_cast<int>(std::min(x0, x1)) - 2; u <= std::max(x0, x1) + 2; ++u) {
        const double along =
            std::clamp(((u + 0.5 - x0) * dx + (v + 0.5 - y0) * dy) / (far * far), 0.0, 1.0);
        mix(u, v, kCallout,
            std::clamp(1.3 - std::hypot(u + 0.5 - x0 - along * dx, v + 0.5 - y0 - along * dy), 0.0,
                       1.0));
      }
    }
  }
  void write(double x, double y, int number) {
    const std::string text = std::to_string(number);
    const double step = 2;
    double left = x - (static_cast<double>(text.size()) * 6 - 1) * step / 2;
    for (const char digit : text) {
      const auto& rows = kDigits[static_cast<std::size_t>(digit - '0')];
      for (int v = 0; v < 14; ++v) {
        for (int u = 0; u < 10; ++u) {
          if ((rows[static_cast<std::size_t>(v / 2)] >> (4 - u / 2) & 1) != 0)
            mix(static_cast<int>(left) + u, static_cast<int>(y) - 7 + v, kInk, 1);
        }
      }
      left += 6 * step;
    }
  }

  std::vector<Colour>& picture_;
  const Camera& camera_;
};

/// The most frequent colours, of 5 bits each, and each colour's nearest.
std::string packed(const std::vector<Colour>& picture, const Camera& camera) {
  std::map<int, int> counts;
  std::vector<int> keys;
  const auto bits = [](double c) {
    return static_cast<int>(std::lround(std::clamp(c, 0.0, 1.0) * 31));
  };
  for (const Colour& c : picture) {
    keys.push_back(bits(c.x) << 10 | bits(c.y) << 5 | bits(c.z));
    ++counts[keys.back()];
  }
  std::vector<std::pair<int, int>> frequent;
  for (const auto& [key, count] : counts) frequent.emplace_back(-count, key);
  std::sort(frequent.begin(), frequent.end());
  if (frequent.size() > 128) frequent.resize(128);
  std::vector<std::array<std::uint8_t, 3>> palette;
  for (const auto& [count, key] : frequent) {
    palette.push_back({static_cast<std::uint8_t>((key >> 10) * 255 / 31),
                       static_cast<std::uint8_t>((key >> 5 & 31) * 255 / 31),
                       static_cast<std::uint8_t>((key & 31) * 255 / 31)});
  }
  std::map<int, std::uint8_t> index_of;
  for (const auto& [key, count] : counts) {
    int best = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < frequent.size(); ++i) {
      int square = 0;
      for (const int shift : {0, 5, 10}) {
        const int d = (frequent[i].second >> shift & 31) - (key >> shift & 31);
        square += d * d;
      }
      if (square < best) {
        best = square;
        index_of[key] = static_cast<std::uint8_t>(i);
      }
    }
  }
  std::vector<std::uint8_t> indices;
  for (const int key : keys) indices.push_back(index_of[key]);
  return case_io::png_of_indexed(camera.width, camera.height, palette, indices);
}

}  // namespace

std::string draw_picture(std::span<const Drawn> drawn,
                         std::span<const Callout> callouts,
                         const Camera& camera) {
  Drawing drawing(drawn, camera);
  std::vector<Colour> picture = drawing.colours();
  Numbering(picture, camera).draw(callouts, drawing);
  return packed(picture, camera);
}

}  // namespace carpus::hardware
