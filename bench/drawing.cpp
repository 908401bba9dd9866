// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/drawing.hpp"

#include "bench/output_file.hpp"

#ifdef CARPUS_HAS_RSVG
#include <librsvg/rsvg.h>

#include <memory>
#endif

#include "core/error.hpp"

namespace carpus::bench {
namespace {

#ifdef CARPUS_HAS_RSVG
constexpr double kPixelsPerUnit = 2;

void save_png(const std::filesystem::path& file, const std::string& svg) {
  const std::unique_ptr<RsvgHandle, void (*)(gpointer)> handle(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), nullptr),
      g_object_unref);
  gboolean has_view_box = FALSE;
  RsvgRectangle view_box{};
  if (handle) {
    rsvg_handle_get_intrinsic_dimensions(handle.get(), nullptr, nullptr, nullptr, nullptr,
                                         &has_view_box, &view_box);
  }
  if (has_view_box == FALSE) throw IoError(file.string() + ": the plot has no measures");
  const double width = view_box.width * kPixelsPerUnit;
  const double height = view_box.height * kPixelsPerUnit;
  const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width),
                                 static_cast<int>(height)),
      cairo_surface_destroy);
  const std::unique_ptr<cairo_t, void (*)(cairo_t*)> context(cairo_create(surface.get()),
                                                             cairo_destroy);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  const RsvgRectangle page{0, 0, width, height};
  if (rsvg_handle_render_document(handle.get(), context.get(), &page, nullptr) == FALSE ||
      cairo_surface_write_to_png(surface.get(), file.c_str()) != CAIRO_STATUS_SUCCESS) {
    throw IoError(file.string() + ": could not be written; check the folder and the disk");
  }
}
#endif

}  // namespace

void save_drawing(const std::filesystem::path& file, const std::string& svg) {
  if (svg.empty()) throw InvalidInput(file.string() + ": nothing to draw, for no engine ran");
#ifdef CARPUS_HAS_RSVG
  write_whole(std::filesystem::path(file).replace_extension(".png"),
              [&](const std::filesystem::path& part) { save_png(part, svg); });
#endif
  write_text(file, svg);
}

}  // namespace carpus::bench
