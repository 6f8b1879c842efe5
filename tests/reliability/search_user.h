#pragma once

#include <future>
#include <memory>
#include <optional>
#include <stop_token>

#include "app/core/design/shape_search.h"
#include "app/core/session/session.h"
#include "tests/reliability/campaign.h"

namespace palpa::reliability {

/// Searches for shapes in the background while the session is edited, as the panel Targets does:
/// begins, stops, accepts, undoes and discards at random. All functions are called from the thread
/// of the session.
class SearchUser {
 public:
  SearchUser(Campaign& campaign, app::Session& session, std::uint64_t seed)
      : campaign_(campaign), session_(session), random_(seed) {}
  /// Stops the search and waits for its end.
  ~SearchUser() { stop_.request_stop(); }

  /// Performs one random action.
  void act();
  // Numbers so far.
  long begun() const { return begun_; }
  long found() const { return found_; }
  long accepted() const { return accepted_; }

 private:
  using Result = std::optional<app::ShapeResult>;  ///< none if stopped or impossible
  void begin();
  void addTouch();
  void take();
  void accept(const app::ShapeResult& result);

  Campaign& campaign_;
  app::Session& session_;
  Random random_;
  std::shared_ptr<const modeling::Project> searched_;
  std::stop_source stop_;
  std::future<Result> running_;  // its destructor waits
  long begun_ = 0, found_ = 0, accepted_ = 0;
};

}  // namespace palpa::reliability
