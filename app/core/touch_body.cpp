#include "app/core/touch_body.h"

#include "bem/triangle_contact_surface.h"

namespace palpa::app {

TouchBody::TouchBody(std::shared_ptr<const TouchModel> model,
                     std::shared_ptr<bem::GreensColumns> columns)
    : model_(std::move(model)),
      surface_(std::make_unique<bem::TriangleContactSurface>(
          model_->setup().mesh, model_->setup().slots, model_->problem()->dofs())),
      columns_(columns ? std::move(columns)
                       : std::make_shared<bem::GreensColumns>(model_->problem())) {}

}  // namespace palpa::app
