#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

#include "app/core/live/touch_stepper.h"
#include "app/core/live/triple_buffer.h"

namespace palpa::app {

/// A model that the loop can touch. Without a stepper: no model is to be touched any more.
struct ReadyModel {
  std::uint64_t number = 0;
  std::unique_ptr<TouchStepper> stepper;
  /// The first `ended` contacts that were begun have ended, because there was no model before.
  std::uint64_t ended = 0;
  ReadyModel* next = nullptr;  ///< in a list
};

/// Nodes of a model whose columns the contacts wait for.
struct ColumnRequest {
  static constexpr int kMaxNodes = 1024;
  std::uint64_t number = 0;  ///< of the model
  /// The response of this place gives a contact its force.
  bool isOfPlace = false;
  bem::ContactSimulation::WaitingPlace place;
  int count = 0;
  std::array<int, kMaxNodes> nodes{};
};

/// Exchange between the touch loop and its worker, without locks.
struct LoopMailbox {
  struct ColumnRequests {
    ColumnRequest touched, next;  ///< of the model that is touched, and of the model after it
  };

  std::atomic<ReadyModel*> ready{nullptr};    // to the loop; the newest replaces others
  std::atomic<ReadyModel*> retired{nullptr};  // to the worker; a list
  TripleBuffer<ColumnRequests> requested;     // to the worker
  std::atomic<std::uint32_t> loopSignal{0};   // changes when there is something to do
  std::atomic<std::uint32_t> workerSignal{0};

  static void signal(std::atomic<std::uint32_t>& which) {
    which.fetch_add(1, std::memory_order_release);
    which.notify_all();
  }
  /// Adds a model to `retired`.
  void retire(ReadyModel* model) {
    model->next = retired.load(std::memory_order_relaxed);
    while (!retired.compare_exchange_weak(model->next, model, std::memory_order_release)) {
    }
  }
};

}  // namespace palpa::app
