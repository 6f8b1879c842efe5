#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "modeling/editing/change.h"
#include "modeling/editing/command.h"

namespace palpa::modeling {

/// May a command be united with the last step? A drag sends its first motion with `no` and the
/// others with `withLast`.
enum class Merge {
  kNo,
  /// When mergeInto() allows it and neither undo, redo nor saving came between. The united command
  /// is applied to the state before the drag, so that the result does not depend on how many
  /// motions were sent, and a drag back to its start leaves no step. Has no effect in a group.
  kWithLast,
};

/// What perform() did.
struct Performed {
  Change change;           ///< against the state just before
  double deviation = 0.0;  ///< Edited::deviation
};

/// A project with its history. States are kept whole (copies share everything that did not change,
/// 24 bytes per control point for each step that moved points), so that undo and redo give back the
/// earlier state bit for bit. Not for several threads at once.
class Document {
 public:
  static constexpr int kMaxSteps = 500;

  /// A clean document without history.
  explicit Document(Project project, int mostSteps = kMaxSteps);

  const Project& project() const { return *current().project; }

  /// Applies a command. Commands that change nothing leave no step; others end what could be
  /// redone. @throws ModelingError as apply(); the document is as before then, the last motion of a
  /// drag included.
  Performed perform(const Command& command, Merge merge = Merge::kNo);

  /// All steps from here to the matching endGroup() become one with this label. Groups can be
  /// nested; the outermost counts. A group that changed nothing leaves no step.
  void beginGroup(std::string label);
  void endGroup();
  /// Ends the outermost group and goes back to the state before it, as if it had not begun.
  Change cancelGroup();
  bool isInGroup() const { return group_.has_value(); }

  bool canUndo() const { return position_ > 0 && !isInGroup(); }
  bool canRedo() const { return position_ + 1 < states_.size() && !isInGroup(); }
  /// Labels of the steps that undo() and redo() would take; empty when there is none.
  std::string undoLabel() const;
  std::string redoLabel() const;
  /// @throws std::logic_error when canUndo() or canRedo() is false
  Change undo();
  Change redo();

  /// All states that undo and redo lead to, oldest first.
  struct History {
    std::vector<std::string>
        labels;                ///< of the step that led to each state; the first may be empty
    std::size_t position = 0;  ///< the present state
    std::optional<std::size_t> saved;  ///< the state last saved or loaded, when it is among them
  };
  History history() const;
  /// Undoes or redoes up to a state of history(). @throws std::logic_error in a group, or when
  /// there is no such state
  Change goToState(std::size_t position);

  /// Does the project equal what was last saved (or loaded)? The view does not count.
  bool isClean() const;
  void markSaved();

  /// Changes how the window shows the project: saved with the file, but no step, and undo leaves it
  /// as it is.
  void setView(std::string view);

 private:
  struct State {
    std::shared_ptr<const Project> project;
    std::string label;               // of the step that led here
    std::optional<Command> command;  // the same, as long as another may be merged into it
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

  std::deque<State> states_;  // oldest first; those after position_ can be redone
  std::size_t position_ = 0;
  std::size_t mostSteps_;
  std::shared_ptr<const Project> saved_;
  std::optional<Group> group_;
};

}  // namespace palpa::modeling
