#include "app/core/live/touchable_model.h"

#include "bem/compressed/compressed_reference_problem.h"

namespace palpa::app {

TouchableModel::TouchableModel(std::shared_ptr<const TouchModel> model,
                               std::shared_ptr<bem::GreensColumns> columns)
    : model_(std::move(model)),
      surface_(model_->setup().discretisation->makeContactSurface(model_->problem()->dofs())),
      columns_(columns ? std::move(columns) : bem::makeGreensColumns(model_->problem())) {}

}  // namespace palpa::app
