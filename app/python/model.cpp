#include "app/python/model.h"

namespace palpa::python {

std::shared_ptr<const app::TouchableModel> Model::touchable() {
  const std::scoped_lock lock(making_);
  if (!touchable_) touchable_ = std::make_shared<const app::TouchableModel>(model_);
  return touchable_;
}

app::TouchState Model::play(const std::vector<modeling::Touch>& touches, int steps,
                            const Job& job) {
  const std::scoped_lock lock(playing_);
  if (!player_) player_ = std::make_unique<app::TouchPlayer>(*model_);
  return player_->play(touches, steps, job);
}

app::StiffnessGradient Model::gradient(const app::TouchState::Contact& contact, const Job& job) {
  const std::scoped_lock lock(deriving_);
  if (!gradients_) gradients_ = std::make_unique<app::StiffnessGradients>(project_, *model_, job);
  return gradients_->of(app::stiffnessRuleOf(contact), job);
}

}  // namespace palpa::python
