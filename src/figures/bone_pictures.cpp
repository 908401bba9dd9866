// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "figures/bone_pictures.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "case_io/bone_bitmap.hpp"
#include "core/text_format.hpp"
#include "drawing/facets.hpp"
#include "drawing/svg.hpp"
#include "drawing/view.hpp"
#include "hull/fast_hull.hpp"
#include "hull/merged_faces.hpp"
#include "mesh/normals.hpp"
#include "mesh/simplify.hpp"

namespace carpus::figures {
namespace {

using drawing::Colour;

constexpr Colour kBone{0.90, 0.84, 0.71};
constexpr Colour kMarked{0.96, 0.62, 0.42};
constexpr Colour kHull{0.55, 0.72, 1.00};
constexpr Colour kHullEdge{0.08, 0.20, 0.50};
constexpr std::string_view kFacetEdge = "#3a3226";
constexpr std::string_view kInk = "#222222";
constexpr std::string_view kArrow = "#c4161c";

/// Of a bone in the picture; more would not be seen and fill the page.
constexpr std::size_t kMostFacets = 2400;
/// Aslant, as one looks at a bone that lies on a table.
constexpr Vec3 kAslant{0.55, 0.75, 0.35};

/// From Wrist (+x proximal, +z volar) to what DrawnBone says.
Vec3 upright(const Vec3& p) { return {-p.y, p.z, -p.x}; }

void append(TriangleMesh& to, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const Triangle& t : other.facets) {
    to.facets.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
}

struct HullToDraw {
  ConvexPolytope polytope;
  std::vector<hull::PolygonalFace> faces;

  explicit HullToDraw(const TriangleMesh& surface)
      : polytope(hull::build_fast_hull(surface.vertices).polytope),
        faces(hull::merged_faces(polytope)) {}
  [[nodiscard]] drawing::Solid solid() const {
    drawing::Solid solid{polytope.vertices, {}};
    for (const hull::PolygonalFace& face : faces) {
      solid.faces.push_back(
          {face.corners, face.neighbours, polytope.planes[face.facets[0]].normal});
    }
    return solid;
  }
};

drawing::SurfacePaint paint_of(const Colour& colour, Facets facets) {
  drawing::SurfacePaint paint{[colour](std::size_t) { return colour; }};
  if (facets == Facets::Outlined) {
    paint.edges = kFacetEdge;
    paint.edge_width = 0.35;
  }
  return paint;
}

Colour in_palette(std::uint8_t texel) {
  const auto& c = case_io::BoneBitmap::palette()[texel];
  return {c[0] / 255.0, c[1] / 255.0, c[2] / 255.0};
}

Colour product(const Colour& a, const Colour& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

/// Of each facet, looked up in the bitmap at its middle.
std::vector<Colour> facet_colours(const case_io::BoneBitmap& bitmap) {
  const auto side = static_cast<std::size_t>(bitmap.atlas.side);
  std::vector<Colour> colours;
  for (const Triangle& t : bitmap.atlas.facets) {
    std::array<std::size_t, 2> texel{};
    for (std::size_t k = 0; k < 2; ++k) {
      double middle = 0;
      for (const std::uint32_t v : t) middle += bitmap.atlas.uv[v][k] / 3;
      texel[k] = std::min(side - 1, static_cast<std::size_t>(middle * bitmap.atlas.side));
    }
    colours.push_back(in_palette(bitmap.texels[texel[1] * side + texel[0]]));
  }
  return colours;
}

double luminance(const Colour& c) { return 0.3 * c[0] + 0.6 * c[1] + 0.1 * c[2]; }

/// A texture without borders between facets: colours of the corners, each the mean of the facets
/// about it; of a facet the mean of its corners', and how much brighter each corner is.
struct SmoothTexture {
  std::vector<Colour> colours;
  std::vector<std::array<double, 3>> factors;

  SmoothTexture(const TriangleMesh& mesh, const std::vector<Colour>& of_facets) {
    std::vector<Colour> sums(mesh.vertices.size(), Colour{});
    std::vector<double> counts(mesh.vertices.size(), 0);
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
      for (const std::uint32_t v : mesh.facets[f]) {
        for (std::size_t c = 0; c < 3; ++c) sums[v][c] += of_facets[f][c];
        counts[v] += 1;
      }
    }
    for (const Triangle& t : mesh.facets) {
      Colour mean{};
      std::array<double, 3> bright{};
      for (std::size_t k = 0; k < 3; ++k) {
        const double share = 1 / counts[t[k]];
        for (std::size_t c = 0; c < 3; ++c) mean[c] += sums[t[k]][c] * share / 3;
        bright[k] = luminance(sums[t[k]]) * share;
      }
      for (double& b : bright) b /= std::max(luminance(mean), 1e-3);
      colours.push_back(mean);
      factors.push_back(bright);
    }
  }
};

std::string name_in_words(BoneId bone) {
  std::string name(name_of(bone));
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  if (name.starts_with("Metacarpal")) name.insert(name.size() - 1, " ");
  return name;
}

/// Towards `tip`, from a corner of the page.
std::string arrow_to(const Vec2& tip) {
  constexpr double kLength = 150;
  constexpr double kHead = 22;
  const double side = tip.x < 450 ? -1 : 1;
  const Vec2 along{-side * 0.86, -0.51};  // towards the tip, y down
  const Vec2 from{tip.x - along.x * kLength, tip.y - along.y * kLength};
  const Vec2 back{tip.x - along.x * kHead, tip.y - along.y * kHead};
  const std::array<Vec2, 3> head{
      tip, Vec2{back.x - along.y * kHead * 0.45, back.y + along.x * kHead * 0.45},
      Vec2{back.x + along.y * kHead * 0.45, back.y - along.x * kHead * 0.45}};
  return drawing::strokes(drawing::line_path(from, back), {kArrow, 6}) + "<path fill=\"" +
         std::string(kArrow) + "\" d=\"" + drawing::polygon_path(head) + "\"/>\n";
}

}  // namespace

std::vector<DrawnBone> drawn_bones(const cases::CaseData& data, double most_error_mm) {
  std::vector<DrawnBone> drawn;
  for (const BoneId id : kAllBones) {
    DrawnBone bone{id, {}, {}};
    for (const cases::Bone& part : data.bones) {
      if (part.bone != id) continue;
      TriangleMesh surface = mesh::simplify(part.surface, {kMostFacets, most_error_mm}).mesh;
      cases::Bone thinned;
      thinned.surface = MeshIn<frame::Bone>(surface);
      const auto colours = facet_colours(case_io::make_bone_bitmap(thinned, data.ct.view()));
      bone.texture.insert(bone.texture.end(), colours.begin(), colours.end());
      for (Vec3& v : surface.vertices) {
        const Point<frame::Patient> seen = part.patient_from_bone * Point<frame::Bone>{v};
        v = upright((data.wrist_from_patient * seen).v);
      }
      append(bone.surface, surface);
    }
    if (!bone.surface.facets.empty()) drawn.push_back(std::move(bone));
  }
  return drawn;
}

std::vector<Vec2> outline_points(const DrawnBone& bone, std::size_t count) {
  const std::size_t step =
      std::max<std::size_t>(1, bone.surface.vertices.size() / std::max<std::size_t>(1, count));
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < bone.surface.vertices.size(); i += step) {
    points.push_back({bone.surface.vertices[i].x, bone.surface.vertices[i].z});
  }
  return points;
}

std::string draw_wrist(const std::vector<DrawnBone>& bones,
                       WristSide side,
                       Facets facets,
                       const BoneId* marked) {
  constexpr drawing::PageArea kScene{20, 20, 860, 1060};
  TriangleMesh all;
  std::vector<Colour> colours;
  TriangleMesh pointed_at;
  for (const DrawnBone& bone : bones) {
    const bool stands_out = marked != nullptr && *marked == bone.bone;
    append(all, bone.surface);
    const Colour& own = stands_out ? kMarked : kBone;
    if (facets == Facets::Textured) {
      for (const Colour& texel : bone.texture) colours.push_back(product(own, texel));
    } else {
      colours.resize(all.facets.size(), own);
    }
    if (stands_out) pointed_at = bone.surface;
  }
  const drawing::View view(all.vertices, kScene, {0, side == WristSide::Dorsal ? -1.0 : 1.0, 0});
  drawing::SurfacePaint paint = paint_of(kBone, facets);
  paint.colour = [&](std::size_t facet) { return colours[facet]; };
  std::vector<Vec3> normals;
  if (facets != Facets::Outlined) paint.normals = normals = mesh::vertex_normals(all);
  const SmoothTexture smooth(all, colours);
  if (facets == Facets::Textured) {
    paint.colour = [&](std::size_t facet) { return smooth.colours[facet]; };
    paint.factors = smooth.factors;
  }
  std::string svg = draw_surface(view, all, paint);
  if (!pointed_at.vertices.empty()) {
    Vec3 middle;
    for (const Vec3& v : pointed_at.vertices) middle = middle + v;
    svg += arrow_to(view(middle * (1.0 / static_cast<double>(pointed_at.vertices.size()))));
  }
  return drawing::page(900, 1100, svg);
}

std::string draw_texture_mapping(const cases::Bone& bone, const GridView<const std::int16_t>& ct) {
  constexpr double kPanel = 430;
  constexpr int kPixels = 128;  // enough for a page
  cases::Bone thinned;
  constexpr std::size_t kFewFacets = 700;  // so that a facet is seen
  constexpr double kMostErrorMm = 0.3;
  thinned.surface =
      MeshIn<frame::Bone>(mesh::simplify(bone.surface, {kFewFacets, kMostErrorMm}).mesh);
  const case_io::BoneBitmap bitmap = case_io::make_bone_bitmap(thinned, ct, kPixels);
  const mesh::TextureAtlas& atlas = bitmap.atlas;
  const drawing::View view(thinned.surface.vertices, {20 + kPanel, 40, kPanel - 40, kPanel - 60},
                           kAslant);
  // The largest facet that looks at the viewer.
  std::size_t shown = 0;
  double largest = 0;
  for (std::size_t f = 0; f < thinned.surface.facets.size(); ++f) {
    const Triangle& t = thinned.surface.facets[f];
    const Vec3 twice = cross(thinned.surface.vertices[t[1]] - thinned.surface.vertices[t[0]],
                             thinned.surface.vertices[t[2]] - thinned.surface.vertices[t[0]]);
    const double towards = dot(twice, normalized_or(kAslant, {0, 1, 0}));
    if (towards > 0.95 * length(twice) && length(twice) > largest) {
      largest = length(twice);
      shown = f;
    }
  }
  const double left = 20;
  const double top = 40;
  const double size = kPanel - 60;
  std::string svg =
      drawing::text_at(left, 26, format("bitmap, %d x %d texels of 256 colours", kPixels, kPixels),
                       {.size = 17}) +
      drawing::text_at(left + kPanel, 26, "one facet of the bone", {.size = 17});
  svg += "<g shape-rendering=\"crispEdges\">\n";
  const double texel = size / kPixels;
  for (int y = 0; y < kPixels; ++y) {
    for (int x = 0; x < kPixels; ++x) {
      const std::uint8_t value = bitmap.texels[static_cast<std::size_t>(y * kPixels + x)];
      svg += format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"",
                    left + x * texel, top + y * texel, texel + 0.1, texel + 0.1) +
             drawing::hex(product(kBone, in_palette(value))) + "\"/>\n";
    }
  }
  svg += "</g>\n";
  std::vector<Vec2> in_bitmap;
  std::vector<Vec2> on_bone;
  for (const std::uint32_t v : atlas.facets[shown]) {
    in_bitmap.push_back({left + atlas.uv[v][0] * size, top + atlas.uv[v][1] * size});
    on_bone.push_back(view(thinned.surface.vertices[atlas.sources[v]]));
  }
  const std::vector<Colour> colours = facet_colours(bitmap);
  const std::vector<Vec3> normals = mesh::vertex_normals(thinned.surface);
  svg += draw_surface(
      view, thinned.surface,
      {[&](std::size_t f) { return product(kBone, colours[f]); }, kFacetEdge, 0.3, normals});
  for (std::size_t i = 0; i < 3; ++i) {
    svg += drawing::strokes(drawing::line_path(in_bitmap[i], on_bone[i]), {kArrow, 0.8, 0.7});
  }
  svg += drawing::strokes(drawing::polygon_path(in_bitmap), {kArrow, 2}) +
         drawing::strokes(drawing::polygon_path(on_bone), {kArrow, 2});
  return drawing::page(2 * kPanel, kPanel, svg);
}

std::string draw_bones_and_hulls(const std::vector<const DrawnBone*>& bones, Facets facets) {
  constexpr double kPanel = 430;
  std::string svg;
  double top = 0;
  for (const DrawnBone* bone : bones) {
    const HullToDraw hull(bone->surface);
    const drawing::View left(hull.polytope.vertices, {20, top + 40, kPanel - 40, kPanel - 60},
                             kAslant);
    const drawing::View right(hull.polytope.vertices,
                              {20 + kPanel, top + 40, kPanel - 40, kPanel - 60}, kAslant);
    const std::string name = name_in_words(bone->bone);
    const auto facets_of = [](std::size_t count) { return format(", %zu facets", count); };
    svg +=
        drawing::text_at(20, top + 26, name + facets_of(bone->surface.facets.size()),
                         {.size = 17}) +
        drawing::text_at(20 + kPanel, top + 26,
                         "its convex hull" + facets_of(hull.polytope.facets.size()), {.size = 17});
    svg += draw_surface(left, bone->surface, paint_of(kBone, facets));
    svg += draw_surface(right, hull.polytope.surface(), paint_of(kHull, facets));
    if (facets == Facets::Shaded) svg += draw_edges(right, hull.solid(), kHullEdge, 0.4);
    top += kPanel;
  }
  return drawing::page(2 * kPanel, top, svg);
}

std::string draw_bones_in_hulls(const std::vector<const DrawnBone*>& bones) {
  constexpr double kPanel = 300;
  constexpr std::size_t kRow = 4;
  std::string svg;
  for (std::size_t i = 0; i < bones.size(); ++i) {
    const HullToDraw hull(bones[i]->surface);
    const drawing::PageArea area{static_cast<double>(i % kRow) * kPanel + 20,
                                 static_cast<double>(i / kRow) * kPanel + 40, kPanel - 40,
                                 kPanel - 60};
    const drawing::View view(hull.polytope.vertices, area, kAslant);
    svg += drawing::text_at(
        area.left, area.top - 14,
        format("(%c) ", static_cast<char>('a' + i)) + name_in_words(bones[i]->bone),
        {.colour = kInk, .size = 17});
    svg += draw_surface(view, bones[i]->surface, paint_of(kBone, Facets::Shaded));
    svg += draw_faces(view, hull.solid(), kHull, 0.25);
    svg += draw_edges(view, hull.solid(), kHullEdge, 0.3);
  }
  const std::size_t rows = (bones.size() + kRow - 1) / kRow;
  return drawing::page(kPanel * kRow, kPanel * static_cast<double>(rows), svg);
}

}  // namespace carpus::figures
