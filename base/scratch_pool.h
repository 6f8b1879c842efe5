#pragma once

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace palpa {

/// Scratch memory for the tasks of a parallel loop. Each task takes a piece and gives it back, so
/// there are as many pieces as working threads. Pieces are made when first needed.
template <class Piece>
class ScratchPool {
 public:
  explicit ScratchPool(std::function<Piece()> make) : make_(std::move(make)) {}

  Piece take() {
    {
      const std::scoped_lock lock(mutex_);
      if (!free_.empty()) {
        Piece piece = std::move(free_.back());
        free_.pop_back();
        return piece;
      }
    }
    return make_();
  }
  void giveBack(Piece piece) {
    const std::scoped_lock lock(mutex_);
    free_.push_back(std::move(piece));
  }

 private:
  std::function<Piece()> make_;
  std::mutex mutex_;
  std::vector<Piece> free_;
};

}  // namespace palpa
