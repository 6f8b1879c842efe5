#pragma once

#include <xxhash.h>

#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace palpa::app {

/// Hash (XXH3, 128 bits) of values and bytes, in the order in which they are added. Throws
/// std::bad_alloc.
class ContentHash {
 public:
  ContentHash() : state_(XXH3_createState()) {
    if (!state_) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
  }
  void add(const void* data, std::size_t bytes) { XXH3_128bits_update(state_.get(), data, bytes); }
  template <class T>
  void addValue(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    add(&value, sizeof value);
  }
  template <class T>
  void addList(const std::vector<T>& list) {
    addValue(list.size());
    add(list.data(), list.size() * sizeof(T));
  }
  XXH128_hash_t value() const { return XXH3_128bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_;
};

}  // namespace palpa::app
