#include "joint_loads.hpp"

#include <Eigen/Geometry>

#include "face_loads.hpp"
#include "laws.hpp"

namespace oracle::detail {

JointLoads joint_loads(Inputs const& in, Parts const& parts, SliderMotion const& slider, Pairs const* impact_speeds) {
    Matrix4 const way = pose_of_way(in, parts);
    JointLoads loads;
    loads.pairs = pairs_of(in, parts, slider, way, impact_speeds);
    for (int f = 0; f < face_count; ++f) {
        FaceLoads face(in, parts, faces_of_way[f], loads.pairs[faces_of_way[f].axis]);
        face.detect();
        face.load();
        loads.surfaces += face.surfaces();
        loads.lines += face.lines();
        loads.points += face.points();
        loads.faces[f] = face.surfaces() ? FaceKind::surface
                         : face.lines()  ? FaceKind::lines
                         : face.points() ? FaceKind::points
                                         : FaceKind::none;
        loads.potential += face.potential();
    }

    // Way coordinates.  Along a straight way a normal force does not push, and along another as its face falls back; its torque is complete.
    Vector3 normal = Vector3::Zero(), friction = Vector3::Zero(), normal_torque = Vector3::Zero(),
            friction_torque = Vector3::Zero();
    for (int axis : {1, 2}) {
        for (Pair const& pair : loads.pairs[axis]) {
            if (!(pair.elastic > 0)) continue;  // a spring of the bed pushes apices that do not touch, too
            Vector3 const push = pair.side * pair.force * pair.normal;
            normal += Vector3(pair.force * pair.opens + (pair.stays ? push.x() : Real(0)), push.y(), push.z());
            normal_torque += pair.arm.cross(push);
            loads.damping_loss += (pair.force - pair.elastic) * pair.rate;
            Real const speed = pair.slip.norm();
            if (!parts.friction || speed == 0) continue;
            Vector3 const drag = -friction_value(in, speed) * pair.force / speed * pair.slip;
            friction += drag;
            friction_torque += pair.arm.cross(drag);
            loads.friction_loss -= drag.dot(pair.slip);
        }
    }
    Matrix3 const turn_back = way.topLeftCorner<3, 3>();
    loads.normal = turn_back * normal;
    loads.normal_torque = turn_back * normal_torque;
    loads.force = loads.normal + turn_back * friction;
    loads.torque = loads.normal_torque + turn_back * friction_torque;
    return loads;
}

}  // namespace oracle::detail
