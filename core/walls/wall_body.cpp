#include "core/walls/wall_body.hpp"

#include <Eigen/Geometry>

namespace grainbench {

namespace {

using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

Eigen::Vector3d eigen(const Vec3& v) {
    return {v.x, v.y, v.z};
}

Vec3 plain(const Eigen::Vector3d& v) {
    return {v.x(), v.y(), v.z()};
}

}  // namespace

WallBody::WallBody(const Wall& wall, const std::string& where, Index material)
    : name_(wall.name), material_(material), surface_(wall.shape, where) {
    set_motion(wall.motion, 0.0);
}

void WallBody::set_motion(const WallMotion& motion, double t) {
    motion_choice_ = motion;
    motion_start_ = t;
    motion_ = MotionEvaluator(motion, t);
}

void WallBody::move(double dt) {
    displacement_ += dt * velocity_.linear;
    const double speed = norm(velocity_.angular);
    if (speed > 0.0) {
        turned_ = true;
        const Eigen::Quaterniond turn(
            Eigen::AngleAxisd(speed * dt, eigen((1.0 / speed) * velocity_.angular)));
        Eigen::Quaterniond pose(quaternion_[0], quaternion_[1], quaternion_[2], quaternion_[3]);
        pose = (turn * pose).normalized();
        quaternion_[0] = pose.w();
        quaternion_[1] = pose.x();
        quaternion_[2] = pose.y();
        quaternion_[3] = pose.z();
        Eigen::Map<RowMatrix> rows(rotation_);
        rows = pose.toRotationMatrix();
        const Vec3& centre = motion_.centre();
        displacement_ = centre + plain(turn * eigen(displacement_ - centre));
    }
}

Vec3 WallBody::to_wall(const Vec3& point) const {
    const Vec3 arm = point - displacement_;
    if (!turned_) {
        return arm;
    }
    // As core/kernels/search_pass.hpp has it, so that both give the same bits.
    const double* r = rotation_;
    return {dot(Vec3{r[0], r[3], r[6]}, arm),
            dot(Vec3{r[1], r[4], r[7]}, arm),
            dot(Vec3{r[2], r[5], r[8]}, arm)};
}

Vec3 WallBody::direction_to_space(const Vec3& direction) const {
    if (!turned_) {
        return direction;
    }
    return plain(Eigen::Map<const RowMatrix>(rotation_) * eigen(direction));
}

Vec3 WallBody::to_space(const Vec3& point) const {
    return displacement_ + direction_to_space(point);
}

double WallBody::relative_speed_bound(double fastest, const Vec3& frame) const {
    const double turning = norm(velocity_.angular);
    // The farthest point of the surface from the centre of rotation moves fastest.
    const double rim =
        turning > 0.0 ? turning * surface_.extent_from(to_wall(motion_.centre())) : 0.0;
    return fastest + norm(velocity_.linear - frame) + rim;
}

void WallBody::save(Archive& archive, const std::string& name) const {
    archive.put(name + "/pose",
                std::vector<double>{displacement_.x,
                                    displacement_.y,
                                    displacement_.z,
                                    quaternion_[0],
                                    quaternion_[1],
                                    quaternion_[2],
                                    quaternion_[3],
                                    turned_ ? 1.0 : 0.0});
    archive.put(name + "/motion_start", motion_start_);
    archive.put(name + "/velocity",
                std::vector<double>{velocity_.linear.x,
                                    velocity_.linear.y,
                                    velocity_.linear.z,
                                    velocity_.angular.x,
                                    velocity_.angular.y,
                                    velocity_.angular.z});
    archive.put(name + "/rotation", std::vector<double>(rotation_, rotation_ + 9));
}

void WallBody::load(const Archive& archive, const std::string& name) {
    const auto& pose = archive.get<double>(name + "/pose", 8);
    displacement_ = {pose[0], pose[1], pose[2]};
    std::copy_n(pose.begin() + 3, 4, quaternion_);
    turned_ = pose[7] != 0.0;
    // The choice of motion comes from the stages; only when it began is part of the state.
    set_motion(motion_choice_, archive.number(name + "/motion_start"));
    const auto& v = archive.get<double>(name + "/velocity", 6);
    velocity_ = {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
    const auto& rotation = archive.get<double>(name + "/rotation", 9);
    std::copy_n(rotation.begin(), 9, rotation_);
}

}  // namespace grainbench
