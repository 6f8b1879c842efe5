#include "modeling/editing/document.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace palpa::modeling {

Document::Document(Project project, int mostSteps)
    : mostSteps_(static_cast<std::size_t>(std::max(mostSteps, 1))) {
  saved_ = std::make_shared<const Project>(std::move(project));
  states_.push_back({saved_, "", std::nullopt});
}

Performed Document::perform(const Command& command, Merge merge) {
  const bool mayMerge = merge == Merge::kWithLast && !group_ && position_ > 0 &&
                        current().command && current().project != saved_;
  if (mayMerge) {
    Command merged = *current().command;
    if (mergeInto(merged, command)) return performMerged(merged);
  }
  Edited edited = apply(command, project());
  Performed performed{compare(project(), edited.project), edited.deviation};
  if (performed.change.any()) {
    push({std::make_shared<const Project>(std::move(edited.project)), label(command), command});
  } else {
    states_[position_].command.reset();  // later motions must not merge into the last step
  }
  return performed;
}

Performed Document::performMerged(const Command& merged) {
  const Project& before = *states_[position_ - 1].project;
  Edited edited = apply(merged, before);
  edited.project.view = project().view;
  Performed performed{compare(project(), edited.project), edited.deviation};
  Change total = compare(before, edited.project);
  total.view = false;
  if (total.any()) {
    states_[position_] = {std::make_shared<const Project>(std::move(edited.project)), label(merged),
                          merged};
  } else {
    goTo(position_ - 1);
    states_.resize(position_ + 1);
  }
  return performed;
}

void Document::push(State state) {
  states_.resize(position_ + 1);
  if (group_ && position_ > group_->position) {
    states_.back() = std::move(state);
    return;
  }
  states_.push_back(std::move(state));
  ++position_;
  if (!group_) trim();
}

void Document::trim() {
  while (position_ > mostSteps_) {
    states_.pop_front();
    --position_;
  }
}

void Document::beginGroup(std::string label) {
  if (!group_) group_ = Group{0, std::move(label), states_, position_};
  ++group_->depth;
}

void Document::endGroup() {
  if (!group_) throw std::logic_error("Document::endGroup: no group was begun");
  if (--group_->depth > 0) return;
  Group group = std::move(*group_);
  group_.reset();
  State& last = states_[position_];
  last.command.reset();
  if (position_ == group.position) return;
  Change total = compare(*group.states[group.position].project, *last.project);
  total.view = false;
  if (total.any()) {
    last.label = std::move(group.label);
    trim();
    return;
  }
  const std::string view = project().view;
  states_ = std::move(group.states);
  position_ = group.position;
  setView(view);
}

Change Document::cancelGroup() {
  if (!group_) throw std::logic_error("Document::cancelGroup: no group was begun");
  const auto before = current().project;
  states_ = std::move(group_->states);
  position_ = group_->position;
  group_.reset();
  setView(before->view);
  return compare(*before, project());
}

std::string Document::undoLabel() const {
  return canUndo() ? current().label : std::string();
}

std::string Document::redoLabel() const {
  return canRedo() ? states_[position_ + 1].label : std::string();
}

Change Document::goTo(std::size_t position) {
  const auto before = current().project;
  position_ = position;
  states_[position_].command.reset();
  setView(before->view);
  return compare(*before, project());
}

Change Document::undo() {
  if (!canUndo()) throw std::logic_error("Document::undo: there is nothing to undo");
  return goTo(position_ - 1);
}

Change Document::redo() {
  if (!canRedo()) throw std::logic_error("Document::redo: there is nothing to redo");
  return goTo(position_ + 1);
}

Document::History Document::history() const {
  History history{{}, position_, std::nullopt};
  history.labels.reserve(states_.size());
  for (const State& state : states_) {
    if (state.project == saved_) history.saved = history.labels.size();
    history.labels.push_back(state.label);
  }
  return history;
}

std::shared_ptr<const Project> Document::state(std::size_t position) const {
  if (position >= states_.size()) throw std::logic_error("Document::state: there is no such state");
  return states_[position].project;
}

Change Document::goToState(std::size_t position) {
  if (isInGroup() || position >= states_.size())
    throw std::logic_error("Document::goToState: there is no such state to go to");
  return goTo(position);
}

bool Document::isClean() const {
  if (current().project == saved_) return true;
  Change change = compare(*saved_, project());
  change.view = false;
  return !change.any();
}

void Document::markSaved() {
  saved_ = current().project;
}

void Document::setView(std::string view) {
  if (project().view == view) return;
  Project changed = project();
  changed.view = std::move(view);
  const bool wasSaved = current().project == saved_;
  states_[position_].project = std::make_shared<const Project>(std::move(changed));
  if (wasSaved) saved_ = states_[position_].project;
}

}  // namespace palpa::modeling
