// A task: how the base leans, pitch and roll.
#include "controller/added_task.hpp"
#include "tests/seams/additions.hpp"

namespace ballbot::test {
namespace {

class LeanTask final : public AddedTaskOf<2> {
 public:
  using AddedTaskOf::AddedTaskOf;

  void residual(const StateVector& x, const Vector3& reference, Vector3& e,
                TaskJacobian* J) const noexcept override {
    e.head<2>() = x.segment<2>(kPitch) - reference.head<2>();
    if (J) (*J)(0, kPitch) = (*J)(1, kRoll) = 1;
  }
};

}  // namespace

void addLeanTask() {
  taskKinds().add(
      {"lean", "pitch and roll of the base", [](const RobotParameters&, const StateVector& rest) {
         return std::make_shared<LeanTask>("lean", rest.segment<2>(kPitch));
       }});
}

}  // namespace ballbot::test
