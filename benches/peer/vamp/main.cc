// VAMP's RRT-Connect with the settings of its script evaluate_mbm.py on the problems of standard input, which problems.py writes.
//
// A line a problem: its name, whether start and goal are free, and if both are: iterations (one more than the limit without a path), nodes of both
// trees and planning time in ns; with a path its length before and after simplification, and the time of that in ns.

#include <array>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>

#include <vamp/collision/factory.hh>
#include <vamp/planning/rrtc.hh>
#include <vamp/planning/simplify.hh>
#include <vamp/planning/validate.hh>
#include <vamp/random/halton.hh>
#include VAMP_HEADER

using Robot = vamp::robots::VAMP_ROBOT;
static constexpr std::size_t rake = vamp::FloatVectorWidth;
using Scalar = vamp::collision::Environment<float>;
using Vector = vamp::collision::Environment<vamp::FloatVector<rake>>;
namespace factory = vamp::collision::factory;

template <typename Numbers>
void read(std::istream &in, Numbers &numbers)
{
    for (auto &number : numbers)
    {
        in >> number;
    }
}

void solve(const std::string &name, Scalar &scene, const Robot::ConfigurationArray ends[2])
{
    scene.sort();
    const Vector world(scene);
    const Robot::Configuration start(ends[0]), goal(ends[1]);
    const auto is_free = [&](const auto &at) { return vamp::planning::validate_motion<Robot, rake, 1>(at, at, world); };
    const bool starts = is_free(start), ends_well = is_free(goal);
    std::cout << name << ' ' << starts << ' ' << ends_well;
    if (starts and ends_well)
    {
        vamp::planning::RRTCSettings settings;
        settings.range = VAMP_RANGE;
        settings.max_iterations = settings.max_samples = 1000000;
        const auto halton = std::make_shared<vamp::rng::Halton<Robot>>();
        auto found =
            vamp::planning::RRTC<Robot, rake, Robot::resolution>::solve(start, goal, world, settings, halton);
        std::cout << ' ' << found.iterations << ' ' << found.size[0] + found.size[1] << ' ' << found.nanoseconds;
        if (not found.path.empty())
        {
            const auto shorter = vamp::planning::simplify<Robot, rake, Robot::resolution>(
                found.path, world, vamp::planning::SimplifySettings(), halton);
            std::cout << ' ' << found.path.cost() << ' ' << shorter.path.cost() << ' ' << shorter.nanoseconds;
        }
    }
    std::cout << '\n';
}

auto main() -> int
{
    Scalar scene;
    std::string line, word, name;
    Robot::ConfigurationArray ends[2];
    while (std::getline(std::cin, line))
    {
        std::istringstream in(line);
        in >> word;
        std::array<float, 3> at, turned, half;
        float radius, length;
        if (word == "problem")
        {
            in >> name;
            scene = Scalar();
        }
        else if (word == "box")
        {
            read(in, at), read(in, turned), read(in, half);
            const auto box = factory::cuboid::array(at, turned, half);
            (box.axis_3_z == 1.F ? scene.z_aligned_cuboids : scene.cuboids).emplace_back(box);
        }
        else if (word == "capsule")
        {
            read(in, at), read(in, turned), in >> radius >> length;
            const auto capsule = factory::cylinder::center::array(at, turned, radius, length);
            (capsule.xv == 0.F and capsule.yv == 0.F ? scene.z_aligned_capsules : scene.capsules).emplace_back(capsule);
        }
        else if (word == "sphere")
        {
            read(in, at), in >> radius;
            scene.spheres.emplace_back(factory::sphere::array(at, radius));
        }
        else if (word == "start")
        {
            read(in, ends[0]);
        }
        else if (word == "goal")
        {
            read(in, ends[1]);
            solve(name, scene, ends);
        }
    }
}
