// Copyright 2026 The Carpus authors
// SPDX-License-Identifier: Apache-2.0
#include "server/access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace carpus::server {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using namespace std::chrono_literals;

class AccessTest : public ::testing::Test {
 protected:
  using Verdict = std::variant<Guest, HttpResponse>;

  [[nodiscard]] Verdict ask(const std::string& target,
                            const std::string& cookie = "",
                            const std::string& address = "10.0.0.1",
                            bool by_browser = true) {
    RequestHead head;
    head.method = "GET";
    head.target = target;
    if (!cookie.empty()) head.fields.push_back({"cookie", cookie});
    if (by_browser) head.fields.push_back({"accept", "text/html,*/*"});
    return access_.judge(head, address, now_);
  }
  static HttpResponse answer(const Verdict& verdict) {
    if (const auto* response = std::get_if<HttpResponse>(&verdict)) return *response;
    ADD_FAILURE() << "was let in";
    return {};
  }
  [[nodiscard]] std::string cookie_for(const std::string& token) {
    const std::string set = answer(ask("/?token=" + token)).set_cookie;
    return set.substr(0, set.find(';'));
  }

  const AccessLinks links_ = make_access_links();
  Access access_{links_, 8080, false};
  Access::Clock::time_point now_ = Access::Clock::now();
};

TEST_F(AccessTest, LinkIsExchangedForACookieThatGivesItsRole) {
  const HttpResponse response = answer(ask("/?token=" + links_.trainee));
  EXPECT_EQ(response.status, 200U);
  EXPECT_THAT(*response.body, AllOf(HasSubstr("url=/\""), Not(HasSubstr(links_.trainee))));
  EXPECT_THAT(response.set_cookie,
              AllOf(StartsWith("carpus-8080=" + links_.trainee), HasSubstr("; HttpOnly"),
                    HasSubstr("; SameSite=Strict"), HasSubstr("; Path=/"), Not(HasSubstr("Secure")),
                    Not(HasSubstr("Domain"))));
  const auto trainee = std::get<Guest>(ask("/", cookie_for(links_.trainee)));
  EXPECT_EQ(trainee.role, Role::Trainee);
  const auto instructor = std::get<Guest>(ask("/", "a=b; " + cookie_for(links_.instructor)));
  EXPECT_EQ(instructor.role, Role::Instructor);
  EXPECT_NE(trainee.browser, instructor.browser);
}

TEST_F(AccessTest, CookieIsForHttpsAloneWherePagesComeByIt) {
  access_ = Access(links_, 443, true);
  EXPECT_THAT(answer(ask("/?token=" + links_.trainee)).set_cookie, HasSubstr("; Secure"));
}

TEST_F(AccessTest, BrowserStaysTheSameWhenItComesByAnotherLink) {
  const std::string first = cookie_for(links_.trainee);
  const std::string again = answer(ask("/?token=" + links_.instructor, first)).set_cookie;
  const auto guest = std::get<Guest>(ask("/", again.substr(0, again.find(';'))));
  EXPECT_EQ(guest.role, Role::Instructor);
  EXPECT_EQ(guest.browser, std::get<Guest>(ask("/", first)).browser);
}

TEST_F(AccessTest, WhoHasNoLinkOrAWrongOneIsToldWhatToDo) {
  const std::string good = cookie_for(links_.trainee);
  for (const auto& [target, cookie] : std::vector<std::pair<std::string, std::string>>{
           {"/", ""},
           {"/api/attempts", ""},
           {"/ws", ""},
           {"/?token=", ""},
           {"/?token=" + make_token(), ""},
           {"/?token=" + links_.trainee + "A", ""},
           {"/?token=" + links_.trainee.substr(1), ""},
           {"/x?token=" + links_.trainee, ""},
           {"/?Token=" + links_.trainee, ""},
           {"/?token=" + make_token(), good},
           {"/", "carpus-8080="},
           {"/", "carpus-8080=" + links_.trainee},
           {"/", "carpus-8080=" + links_.trainee + "." + links_.trainee.substr(1)},
           {"/", "carpus-8080=" + make_token() + "." + make_token()},
           {"/", "carpus-8081" + good.substr(11)},
           {"/", "xcarpus-8080" + good.substr(11)},
           {"/", good + "x"}}) {
    const HttpResponse response = answer(ask(target, cookie));
    EXPECT_EQ(response.status, 403U) << target << " " << cookie;
    EXPECT_TRUE(response.set_cookie.empty());
    EXPECT_THAT(*response.body, HasSubstr("Open the link that the station printed"));
    EXPECT_THAT(*response.body, Not(HasSubstr(links_.trainee)));
  }
  const HttpResponse line = answer(ask("/api/case", "", "10.0.0.1", false));
  EXPECT_THAT(*line.body, HasSubstr("open the link that carpus serve printed"));
}

TEST_F(AccessTest, FailuresAreLimitedPerAddressAndWhoIsInStaysIn) {
  const std::string good = cookie_for(links_.trainee);
  int refused = 0;
  for (int i = 0; i < 100; ++i) {
    if (answer(ask("/?token=" + make_token())).status == 403) ++refused;
  }
  EXPECT_NEAR(refused, Access::kFailuresAtOnce, 1);
  const HttpResponse limited = answer(ask("/", "carpus-8080=" + make_token() + "." + make_token()));
  EXPECT_EQ(limited.status, 429U);
  EXPECT_GT(limited.retry_after_s, 0U);
  EXPECT_TRUE(std::holds_alternative<Guest>(ask("/", good)));
  EXPECT_EQ(answer(ask("/?token=" + make_token(), "", "10.0.0.2")).status, 403U);
  now_ += 10s;
  EXPECT_EQ(answer(ask("/?token=" + make_token())).status, 403U);
}

TEST_F(AccessTest, RemembersABoundedNumberOfAddresses) {
  for (int i = 0; i < 100'000; ++i) {
    (void)ask("/?token=x", "", "address " + std::to_string(i));
  }
  EXPECT_TRUE(std::holds_alternative<Guest>(ask("/", cookie_for(links_.trainee))));
}

}  // namespace
}  // namespace carpus::server
