#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modeling/editing/change.h"
#include "modeling/editing/command.h"

namespace palpa::modeling {

/// Merging of a command with the last step. A drag performs its first motion with kNo and the
/// others with kWithLast.
enum class Merge {
  kNo,
  /// Merges if mergeInto() allows it and neither undo, redo nor saving came between. The merged
  /// command is applied to the state before the drag, so that the result does not depend on the
  /// number of motions, and a drag back to its start leaves no step. Has no effect in a group.
  kWithLast,
};

/// Result of Document::perform().
struct Performed {
  Change change;           ///< from the previous state
  double deviation = 0.0;  ///< Edited::deviation, mm
};

/// A project with its undo history. Complete states are stored, so that undo and redo restore them
/// bit for bit; copies share unchanged parts (24 bytes per control point for each step that moved
/// points). Not thread-safe.
class Document {
 public:
  static constexpr int kMaxSteps = 500;

  /// A clean document without history.
  explicit Document(Project project, int mostSteps = kMaxSteps);

  const Project& project() const { return *current().project; }

  /// Applies a command. A command without effect leaves no step; any other removes the steps that
  /// could be redone. Throws ModelingError as apply() and does not change the document then (the
  /// last motion of a drag remains).
  Performed perform(const Command& command, Merge merge = Merge::kNo);

  /// Begins a group: all steps up to the matching endGroup() become one step with this label.
  /// Groups can be nested; the outermost counts. A group without effect leaves no step.
  void beginGroup(std::string label);
  /// Throws std::logic_error without a group, as cancelGroup().
  void endGroup();
  /// Ends the outermost group and restores the state before it.
  Change cancelGroup();
  bool isInGroup() const { return group_.has_value(); }

  bool canUndo() const { return position_ > 0 && !isInGroup(); }
  bool canRedo() const { return position_ + 1 < states_.size() && !isInGroup(); }
  /// Labels of the steps of undo() and redo(); empty if there is none.
  std::string undoLabel() const;
  std::string redoLabel() const;
  /// Throws std::logic_error if canUndo() is false; redo(), if canRedo() is false.
  Change undo();
  Change redo();

  /// All states that undo and redo can reach, oldest first.
  struct History {
    std::vector<std::string> labels;   ///< of the step to each state; the first may be empty
    std::size_t position = 0;          ///< the current state
    std::optional<std::size_t> saved;  ///< the state last saved or loaded, if it is in the list
  };
  History history() const;
  /// A state of history(). Throws std::logic_error if there is no such state.
  std::shared_ptr<const Project> state(std::size_t position) const;
  /// Undoes or redoes to a state of history(). Throws std::logic_error in a group, or if there is
  /// no such state.
  Change goToState(std::size_t position);

  /// True if the project, without the view, equals the last saved (or loaded) one.
  bool isClean() const;
  void markSaved();

  /// Changes the view of the project in the window. The view is saved with the file, but the change
  /// makes no step, and undo does not affect it.
  void setView(std::string view);

 private:
  struct State {
    std::shared_ptr<const Project> project;
    std::string label;               // of the step to this state
    std::optional<Command> command;  // of this step, while other commands may be merged into it
  };
  struct Group {
    int depth = 0;
    std::string label;
    std::deque<State> states;  // before the group
    std::size_t position = 0;
  };

  const State& current() const { return states_[position_]; }
  Performed performMerged(const Command& merged);
  void push(State state);
  void trim();
  Change goTo(std::size_t position);

  std::deque<State> states_;  // oldest first; states after position_ can be redone
  std::size_t position_ = 0;
  std::size_t mostSteps_;
  std::shared_ptr<const Project> saved_;
  std::optional<Group> group_;
};

}  // namespace palpa::modeling
