// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// Sweeps the grid slice by slice, surrounded by a border of 0. Cubes of one label are passed over
// three at a time. Where the ends of a grid edge differ in label, each end's surface has a vertex
// in its middle, kept until the cubes on both sides of the slab have used it.
#include "mesh/label_surfaces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>

#include "core/check.hpp"
#include "core/error.hpp"
#include "mesh/cube_table.hpp"

namespace carpus::mesh {
namespace {

constexpr std::uint32_t kNoVertex = std::numeric_limits<std::uint32_t>::max();

/// Labels of one slice with its border, and the vertices on the edges that start in it: along x,
/// y, and z (towards the next slice), one for each end's label.
class LabelSlice {
 public:
  explicit LabelSlice(std::size_t area) : labels(area), vertices_(area * 6, kNoVertex) {}

  [[nodiscard]] std::uint32_t& vertex(std::size_t at, std::size_t axis, bool is_of_high_end) {
    return vertices_[at * 6 + axis * 2 + (is_of_high_end ? 1 : 0)];
  }
  void remember(std::size_t at) { touched_.push_back(at); }
  /// Only what was written is taken back.
  void forget_vertices() {
    for (const std::size_t at : touched_) {
      std::fill_n(vertices_.begin() + static_cast<std::ptrdiff_t>(at * 6), 6, kNoVertex);
    }
    touched_.clear();
  }

  std::vector<std::uint16_t> labels;

 private:
  std::vector<std::uint32_t> vertices_;
  std::vector<std::size_t> touched_;
};

/// Four neighbours along x, as one number.
std::uint64_t four_labels(const std::uint16_t* first) {
  std::uint64_t four = 0;
  std::memcpy(&four, first, sizeof four);
  return four;
}

class LabelSweep {
 public:
  explicit LabelSweep(const GridView<const std::uint16_t>& labels)
      : source_(labels),
        nx_(labels.geometry().size[0] + 2),
        ny_(labels.geometry().size[1] + 2),
        nz_(labels.geometry().size[2] + 2),
        low_(area()),
        high_(area()),
        surface_of_(std::size_t{1} << 16U, kNoVertex),
        flips_(labels.geometry().direction.determinant() < 0) {}

  std::vector<LabelSurface> run() {
    for (k_ = 0; k_ + 1 < nz_; ++k_) {
      read_slice(k_ + 1, high_);
      for (int j = 0; j + 1 < ny_; ++j) sweep_row(j);
      std::swap(low_, high_);
      high_.forget_vertices();
    }
    std::sort(surfaces_.begin(), surfaces_.end(),
              [](const LabelSurface& a, const LabelSurface& b) { return a.label < b.label; });
    return std::move(surfaces_);
  }

 private:
  [[nodiscard]] std::size_t area() const {
    return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_);
  }
  [[nodiscard]] std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(i);
  }

  void read_slice(int k, LabelSlice& slice) const {
    if (k == nz_ - 1) {
      std::fill(slice.labels.begin(), slice.labels.end(), std::uint16_t{0});
      return;
    }
    const auto row = static_cast<std::size_t>(nx_ - 2);
    for (int j = 1; j + 1 < ny_; ++j) {
      const std::size_t from = source_.geometry().offset_of({0, j - 1, k - 1});
      std::copy_n(source_.values().begin() + static_cast<std::ptrdiff_t>(from), row,
                  slice.labels.begin() + static_cast<std::ptrdiff_t>(at(1, j)));
    }
  }

  void sweep_row(int j) {
    const std::array<const std::uint16_t*, 4> rows{
        &low_.labels[at(0, j)], &low_.labels[at(0, j + 1)], &high_.labels[at(0, j)],
        &high_.labels[at(0, j + 1)]};
    int i = 0;
    while (i + 1 < nx_) {
      if (i + 3 < nx_) {
        const std::uint64_t alike = 0x0001000100010001U * std::uint64_t{rows[0][i]};
        if (four_labels(rows[0] + i) == alike && four_labels(rows[1] + i) == alike &&
            four_labels(rows[2] + i) == alike && four_labels(rows[3] + i) == alike) {
          i += 3;
          continue;
        }
      }
      mesh_cube(i, j, rows);
      ++i;
    }
  }

  void mesh_cube(int i, int j, const std::array<const std::uint16_t*, 4>& rows) {
    std::array<std::uint16_t, 8> corner{};
    for (std::size_t r = 0; r < 4; ++r) {
      corner[2 * r] = rows[r][i];
      corner[2 * r + 1] = rows[r][i + 1];
    }
    for (std::size_t c = 0; c < 8; ++c) {
      const std::uint16_t label = corner[c];
      if (label == 0 || std::find(corner.begin(), corner.begin() + static_cast<std::ptrdiff_t>(c),
                                  label) != corner.begin() + static_cast<std::ptrdiff_t>(c)) {
        continue;  // no surface, or done
      }
      unsigned configuration = 0;
      for (std::size_t b = 0; b < 8; ++b) configuration |= (corner[b] == label ? 1U : 0U) << b;
      if (configuration != 255) emit(i, j, corner, label, table_[configuration]);
    }
  }

  TriangleMesh& mesh_of(std::uint16_t label) {
    std::uint32_t& index = surface_of_[label];
    if (index == kNoVertex) {
      index = static_cast<std::uint32_t>(surfaces_.size());
      surfaces_.push_back({label, {}});
    }
    return surfaces_[index].mesh;
  }

  std::uint32_t edge_vertex(int i,
                            int j,
                            const std::array<std::uint16_t, 8>& corner,
                            std::uint16_t label,
                            std::uint8_t edge,
                            TriangleMesh& mesh) {
    const CubeEdge& e = kCubeEdges[edge];
    const int above = e.low_corner >> 2 & 1;
    LabelSlice& slice = above != 0 ? high_ : low_;
    const int x = i + (e.low_corner & 1);
    const int y = j + (e.low_corner >> 1 & 1);
    const std::size_t place = at(x, y);
    std::uint32_t& vertex = slice.vertex(place, e.axis, corner[e.high_corner] == label);
    if (vertex == kNoVertex) {
      CARPUS_CHECK(mesh.vertices.size() < kNoVertex);
      Vec3 p{static_cast<double>(x - 1), static_cast<double>(y - 1),
             static_cast<double>(k_ + above - 1)};
      p[e.axis] += 0.5;
      vertex = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(source_.geometry().patient_from_voxel(p));
      slice.remember(place);
    }
    return vertex;
  }

  void emit(int i,
            int j,
            const std::array<std::uint16_t, 8>& corner,
            std::uint16_t label,
            const CubeCase& cube) {
    TriangleMesh& mesh = mesh_of(label);
    std::array<std::uint32_t, 4> centres{};
    for (std::size_t c = 0; c < cube.centred_loops.size(); ++c) {
      Vec3 sum{};
      for (const std::uint8_t e : cube.centred_loops[c]) {
        sum += mesh.vertices[edge_vertex(i, j, corner, label, e, mesh)];
      }
      mesh.vertices.push_back(sum / static_cast<double>(cube.centred_loops[c].size()));
      centres[c] = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    }
    const auto vertex = [&](std::uint8_t name) {
      return name >= kFirstLoopCentre ? centres[static_cast<std::size_t>(name - kFirstLoopCentre)]
                                      : edge_vertex(i, j, corner, label, name, mesh);
    };
    for (const auto& t : cube.triangles) {
      const Triangle facet{vertex(t[0]), vertex(t[1]), vertex(t[2])};
      mesh.facets.push_back(flips_ ? Triangle{facet[0], facet[2], facet[1]} : facet);
    }
  }

  GridView<const std::uint16_t> source_;
  int nx_;  ///< with the border
  int ny_;
  int nz_;
  int k_ = 0;  ///< the slice of low_, counted with the border
  LabelSlice low_;
  LabelSlice high_;
  std::vector<LabelSurface> surfaces_;
  std::vector<std::uint32_t> surface_of_;  ///< [label] index in surfaces_
  const std::array<CubeCase, 256>& table_ = cube_table();
  bool flips_;  ///< a left-handed grid turns triangles over
};

}  // namespace

std::vector<LabelSurface> extract_label_surfaces(const GridView<const std::uint16_t>& labels) {
  if (labels.geometry().voxel_count() == 0) {
    throw InvalidInput("label surfaces: the grid has no voxels");
  }
  return LabelSweep(labels).run();
}

}  // namespace carpus::mesh
