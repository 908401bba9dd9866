// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/access.hpp"

#include <algorithm>
#include <utility>

namespace carpus::server {

namespace {

constexpr Role kTrainee = Role::Trainee;
constexpr Role kInstructor = Role::Instructor;

/// What a person sees who has no link, or a wrong one. No script, nothing to load.
std::string page(std::string_view title, std::string_view text, std::string_view head = {}) {
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">";
  html += "<meta name=\"viewport\" content=\"width=device-width\">";
  html.append(head).append("<title>Carpus</title><style>");
  html +=
      "body{background:#0e1214;color:#e8eef0;font:16px/1.5 sans-serif;margin:15vh auto;"
      "max-width:36em;padding:0 1em}a{color:#5cc8ff}";
  html.append("</style></head><body><main><h1>").append(title).append("</h1>");
  html.append(text).append("</main></body></html>\n");
  return html;
}

HttpResponse html(unsigned status, std::string body) {
  return make_response(status, "text/html; charset=utf-8", std::move(body));
}

bool wants_page(const RequestHead& head) {
  const auto accept = head.find("accept");
  return accept && accept->find("text/html") != std::string_view::npos;
}

HttpResponse refusal(const RequestHead& head, bool link_was_wrong) {
  const std::string_view title =
      link_was_wrong ? "This link is not valid (any more)" : "This station needs its link";
  if (!wants_page(head)) {
    return make_problem(
        403, std::string(title) + ": open the link that carpus serve printed when it started.");
  }
  return html(403, page(title,
                        "<p>Open the link that the station printed when it was started, in the "
                        "window where it runs. It ends in <code>/?token=…</code></p><p>If somebody "
                        "else runs this station, ask them for the link.</p>"));
}

HttpResponse too_often(const RequestHead& head) {
  HttpResponse response =
      wants_page(head)
          ? html(429, page("Too many wrong links came from here",
                           "<p>Wait a minute, then open the right link: the one that the station "
                           "printed when it was started.</p>"))
          : make_problem(429, "Too many wrong links came from here; wait a minute.");
  response.retry_after_s = 60;
  return response;
}

/// The token of a link, "/?token=…"; nothing of any other target.
std::optional<std::string_view> token_of_link(std::string_view target) {
  constexpr std::string_view kStart = "/?token=";
  if (!target.starts_with(kStart)) return std::nullopt;
  return target.substr(kStart.size());
}

/// The value of the cookie of this name; nothing where there is none.
std::optional<std::string_view> cookie(const RequestHead& head, std::string_view name) {
  for (const RequestField& field : head.fields) {
    if (field.name != "cookie") continue;
    std::string_view rest = field.value;
    while (!rest.empty()) {
      const std::size_t end = std::min(rest.find(';'), rest.size());
      std::string_view one = rest.substr(0, end);
      one.remove_prefix(std::min(one.find_first_not_of(' '), one.size()));
      if (one.starts_with(name) && one.substr(name.size()).starts_with('=')) {
        return one.substr(name.size() + 1);
      }
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  }
  return std::nullopt;
}

}  // namespace

Access::Access(AccessLinks links, std::uint16_t port, bool is_secure)
    : links_(std::move(links)),
      cookie_name_("carpus-" + std::to_string(port)),
      is_secure_(is_secure) {}

const Role* Access::role_of(std::string_view token) const noexcept {
  // Both are compared whatever comes of the first.
  const bool is_trainee = same_secret(token, links_.trainee);
  const bool is_instructor = same_secret(token, links_.instructor);
  if (is_instructor) return &kInstructor;
  return is_trainee ? &kTrainee : nullptr;
}

bool Access::may_fail_again(std::string_view address, Clock::time_point now) {
  const std::string key(address);
  const auto found = failures_.find(key);
  if (found != failures_.end()) return found->second.allows(now);
  if (failing_addresses_.size() >= kMaxAddresses) {
    failures_.erase(failing_addresses_.front());
    failing_addresses_.pop_front();
  }
  failing_addresses_.push_back(key);
  return failures_.emplace(key, RateLimit(1.0 / kSecondsPerFailure, kFailuresAtOnce))
      .first->second.allows(now);
}

HttpResponse Access::let_in(const RequestHead& head, std::string_view token) const {
  // The page goes on by itself. A redirect would still count as coming from wherever the link was
  // opened (a mail, a file), and browsers keep a SameSite=Strict cookie back from that.
  HttpResponse response = html(200, page("Carpus", "<p><a href=\"/\">Go on</a></p>",
                                         "<meta http-equiv=\"refresh\" content=\"0;url=/\">"));
  const auto known = cookie(head, cookie_name_);
  const bool knows_browser =
      known && known->size() == 2 * kTokenLength + 1 && is_token(known->substr(kTokenLength + 1));
  const std::string browser =
      knows_browser ? std::string(known->substr(kTokenLength + 1)) : make_token();
  response.set_cookie = cookie_name_ + "=" + std::string(token) + "." + browser +
                        "; Path=/; HttpOnly; SameSite=Strict" + (is_secure_ ? "; Secure" : "");
  return response;
}

std::variant<Guest, HttpResponse> Access::judge(const RequestHead& head,
                                                std::string_view address,
                                                Clock::time_point now) {
  if (const auto token = token_of_link(head.target)) {
    if (role_of(*token) != nullptr) return let_in(head, *token);
    return may_fail_again(address, now) ? refusal(head, true) : too_often(head);
  }
  const auto known = cookie(head, cookie_name_);
  if (!known) return refusal(head, false);
  if (known->size() == 2 * kTokenLength + 1 && (*known)[kTokenLength] == '.' &&
      is_token(known->substr(kTokenLength + 1))) {
    if (const Role* role = role_of(known->substr(0, kTokenLength))) {
      return Guest{*role, std::string(known->substr(kTokenLength + 1))};
    }
  }
  return may_fail_again(address, now) ? refusal(head, true) : too_often(head);
}

}  // namespace carpus::server
