#include "app/core/live/touchable_model.h"

namespace palpa::app {

TouchableModel::TouchableModel(std::shared_ptr<const TouchModel> model,
                               std::shared_ptr<bem::GreensColumns> columns)
    : model_(std::move(model)),
      surface_(model_->setup().discretisation->makeContactSurface(model_->problem()->dofs())),
      columns_(columns ? std::move(columns)
                       : std::make_shared<bem::GreensColumns>(model_->problem())) {}

}  // namespace palpa::app
