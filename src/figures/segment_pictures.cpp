// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/segment_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "case_io/png.hpp"
#include "drawing/facets.hpp"
#include "drawing/svg.hpp"
#include "reconstruct/bone_surface.hpp"
#include "records/atomic_file.hpp"

namespace carpus::figures {
namespace {

namespace fs = std::filesystem;
using imaging::RegionLabel;

/// Bone window of a CT.
constexpr double kWindowLowHu = -200;
constexpr double kWindowHighHu = 1300;
/// Pixels of a picture's longer side, about.
constexpr double kPictureSize = 900;
/// A palette holds greys first, then colours of labels, then white for the lines between them.
constexpr std::uint8_t kGreys = 200;
constexpr std::uint8_t kColours = 54;
constexpr std::uint8_t kLine = kGreys + kColours;
constexpr std::uint8_t kOutsideMarker = kLine + 1;

/// Hues as far apart as can be, neighbours in number never alike: the golden section of the circle.
drawing::Colour colour_of(std::size_t label) {
  const double hue = 6 * std::fmod(0.08 + 0.61803398875 * static_cast<double>(label), 1.0);
  const auto channel = [&](double shift) {
    const double x = std::fmod(hue + shift, 6.0);
    return 0.35 + 0.6 * std::clamp(std::min(x, 4 - x), 0.0, 1.0);
  };
  return {channel(2), channel(0), channel(4)};
}

using Palette = std::vector<std::array<std::uint8_t, 3>>;

std::uint8_t byte_of(double part) {
  return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
}

Palette make_palette() {
  Palette palette;
  for (int i = 0; i < kGreys; ++i) {
    const std::uint8_t grey = byte_of(static_cast<double>(i) / (kGreys - 1));
    palette.push_back({grey, grey, grey});
  }
  for (std::size_t i = 0; i < kColours; ++i) {
    const drawing::Colour c = colour_of(i);
    palette.push_back({byte_of(c[0]), byte_of(c[1]), byte_of(c[2])});
  }
  palette.push_back({255, 255, 255});
  palette.push_back({90, 150, 255});
  return palette;
}

std::uint8_t grey_of(double value, double low, double high) {
  const double part = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
  return static_cast<std::uint8_t>(std::lround(part * (kGreys - 1)));
}

std::uint8_t colour_index(RegionLabel label) {
  return static_cast<std::uint8_t>(kGreys + label % kColours);
}

/// One axial slice enlarged to a picture of square pixels.
class SlicePicture {
 public:
  SlicePicture(const GridGeometry& g, int z) : geometry_(g), z_(z) {
    const double width_mm = g.size[0] * g.spacing.x;
    const double height_mm = g.size[1] * g.spacing.y;
    const double per_mm = kPictureSize / std::max(width_mm, height_mm);
    width_ = std::max(1, static_cast<int>(std::lround(width_mm * per_mm)));
    height_ = std::max(1, static_cast<int>(std::lround(height_mm * per_mm)));
  }
  /// @param paint  from a voxel to an index of the palette.
  template <typename Paint>
  [[nodiscard]] std::string png(const Palette& palette, const Paint& paint) const {
    std::vector<std::uint8_t> pixels;
    pixels.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    for (int row = 0; row < height_; ++row) {
      for (int column = 0; column < width_; ++column) pixels.push_back(paint(voxel(column, row)));
    }
    return case_io::png_of_indexed(width_, height_, palette, pixels);
  }
  /// The pixel to the right and the one below lie in these voxels.
  [[nodiscard]] VoxelIndex voxel(int column, int row) const {
    return {std::min(geometry_.size[0] - 1, column * geometry_.size[0] / width_),
            std::min(geometry_.size[1] - 1, row * geometry_.size[1] / height_), z_};
  }

 private:
  GridGeometry geometry_;
  int z_;
  int width_ = 1;
  int height_ = 1;
};

float greatest_in_slice(const GridView<const float>& values, int z) {
  const auto& size = values.geometry().size;
  float greatest = 0;
  for (int y = 0; y < size[1]; ++y) {
    for (int x = 0; x < size[0]; ++x) greatest = std::max(greatest, values[VoxelIndex{x, y, z}]);
  }
  return greatest;
}

/// Whether `holds` of the label of a neighbour in the slice.
template <typename Predicate>
bool has_beside(const GridView<const RegionLabel>& labels,
                const VoxelIndex& v,
                const Predicate& holds) {
  const std::array<VoxelIndex, 4> beside{
      VoxelIndex{v.x - 1, v.y, v.z}, VoxelIndex{v.x + 1, v.y, v.z}, VoxelIndex{v.x, v.y - 1, v.z},
      VoxelIndex{v.x, v.y + 1, v.z}};
  return std::any_of(beside.begin(), beside.end(), [&](const VoxelIndex& n) {
    return labels.geometry().contains(n) && holds(labels[n]);
  });
}

/// A line between two basins lies in one of them alone.
bool is_at_border(const GridView<const RegionLabel>& labels, const VoxelIndex& v) {
  return has_beside(labels, v, [own = labels[v]](RegionLabel other) { return other < own; });
}

bool is_at_rim(const GridView<const RegionLabel>& labels, const VoxelIndex& v) {
  return has_beside(labels, v, [own = labels[v]](RegionLabel other) { return other != own; });
}

std::string draw_bones(const GridView<const RegionLabel>& labels) {
  constexpr drawing::PageArea kScene{30, 30, 840, 840};
  reconstruct::BoneSurfaceOptions coarse;  // a picture, not a case
  coarse.facets_per_mm2 = 2;
  coarse.least_facets = 500;
  coarse.most_facets = 2500;
  const Grid<float> at_the_border(labels.geometry());  // no grey values: half-way between voxels
  struct Body {
    RegionLabel label;
    TriangleMesh surface;
    double nearness;
  };
  std::vector<Body> bodies;
  std::vector<Vec3> seen;
  Grid<std::uint8_t> one(labels.geometry());
  const RegionLabel last = *std::max_element(labels.values().begin(), labels.values().end());
  for (RegionLabel label = 1; label <= last; ++label) {
    std::transform(
        labels.values().begin(), labels.values().end(), one.values().begin(),
        [&](RegionLabel each) { return each == label ? std::uint8_t{1} : std::uint8_t{0}; });
    const auto field =
        reconstruct::build_bone_field(std::as_const(one).view(), 1, at_the_border.view(), coarse);
    TriangleMesh surface = reconstruct::build_bone_surface(field, coarse);
    if (surface.facets.empty()) continue;
    seen.insert(seen.end(), surface.vertices.begin(), surface.vertices.end());
    bodies.push_back({label, std::move(surface), 0});
  }
  if (bodies.empty()) return drawing::page(900, 900, "");
  const drawing::View view(seen, kScene);
  for (Body& body : bodies) {
    for (const Vec3& p : body.surface.vertices) body.nearness += view.nearness(p);
    body.nearness /= static_cast<double>(body.surface.vertices.size());
  }
  std::sort(bodies.begin(), bodies.end(),
            [](const Body& a, const Body& b) { return a.nearness < b.nearness; });
  std::string svg;
  for (const Body& body : bodies) {
    svg += drawing::draw_surface(view, body.surface, colour_of(body.label));
  }
  return drawing::page(900, 900, svg);
}

}  // namespace

int most_telling_slice(const GridView<const RegionLabel>& labels) {
  const auto& size = labels.geometry().size;
  int best = 0;
  std::pair<std::size_t, std::size_t> best_shows{0, 0};
  for (int z = 0; z < size[2]; ++z) {
    std::vector<bool> present(std::size_t{1} << 16U, false);
    std::pair<std::size_t, std::size_t> shows{0, 0};
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        const RegionLabel label = labels[VoxelIndex{x, y, z}];
        if (label == 0) continue;
        ++shows.second;
        if (!present[label]) ++shows.first;
        present[label] = true;
      }
    }
    if (shows > best_shows) {
      best_shows = shows;
      best = z;
    }
  }
  return best;
}

void write_segment_pictures(const fs::path& folder, const SegmentSteps& steps, int z) {
  std::error_code failed;
  fs::create_directories(folder, failed);  // what fails is said by the first write
  const SlicePicture picture(steps.ct.geometry(), z);
  const Palette palette = make_palette();
  const auto ct_grey = [&](const VoxelIndex& v) {
    return grey_of(steps.ct[v], kWindowLowHu, kWindowHighHu);
  };
  records::write_file_atomically(folder / "1_ct.png", picture.png(palette, ct_grey));
  const auto steepest = static_cast<double>(greatest_in_slice(steps.gradient, z));
  records::write_file_atomically(
      folder / "2_gradient_and_markers.png", picture.png(palette, [&](const VoxelIndex& v) {
        const RegionLabel marker = steps.markers[v];
        if (marker != 0 && is_at_rim(steps.markers, v)) {
          return marker == steps.outside ? kOutsideMarker : colour_index(marker);
        }
        return grey_of(static_cast<double>(steps.gradient[v]), 0, 0.6 * steepest);
      }));
  records::write_file_atomically(
      folder / "3_watershed.png", picture.png(palette, [&](const VoxelIndex& v) {
        const RegionLabel label = steps.labels[v];
        if (label == 0) return ct_grey(v);
        return is_at_border(steps.labels, v) ? kLine : colour_index(label);
      }));
  records::write_file_atomically(folder / "4_bones.svg", draw_bones(steps.labels));
}

}  // namespace carpus::figures
