// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
//
// A page's other end that says back what it hears, for tests of the door alone.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "server/network_server.hpp"

namespace carpus::server::testing {

/// Answers each text frame with itself.
class Echo : public PageHandler {
 public:
  void on_open(const std::shared_ptr<PageConnection>&) override { ++opened; }
  void on_text(const std::shared_ptr<PageConnection>& page, std::string_view text) override {
    ++heard;
    if (text == "flood") {
      for (int i = 0; i < 40; ++i) page->send_binary(std::string(1U << 20U, 'x'));
    } else if (text == "close") {
      page->send_text("goodbye");
      page->close();
    } else {
      if (text == "keep") page->keep();
      page->send_text(std::string(text));
    }
  }
  void on_binary(const std::shared_ptr<PageConnection>& page) override { page->send_text("text!"); }
  void on_alive(const std::shared_ptr<PageConnection>&) override { ++alive; }
  void on_close(const std::shared_ptr<PageConnection>&) override { ++closed; }

  std::atomic<int> opened{0};
  std::atomic<int> heard{0};
  std::atomic<int> alive{0};
  std::atomic<int> closed{0};
};

}  // namespace carpus::server::testing
