// VAMP's header of this name needs the library nigh, which its source distribution leaves out. This one has the same interface and measures
// every node: the trees of MotionBenchMaker's problems hold some hundred nodes.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <vamp/vector.hh>

namespace vamp::planning
{
    template <std::size_t dim>
    struct NNFloatArray
    {
        float *v;
    };

    template <std::size_t dim>
    struct NNNode
    {
        std::size_t index;
        NNFloatArray<dim> array;

        auto as_vector() const noexcept -> FloatVector<dim>
        {
            return FloatVector<dim>(array.v);
        }
    };

    template <std::size_t dim, std::size_t batch = 128>
    struct NN
    {
        std::vector<NNNode<dim>> nodes;

        auto size() const -> std::size_t
        {
            return nodes.size();
        }

        void insert(const NNNode<dim> &node)
        {
            nodes.push_back(node);
        }

        auto nearest(const NNFloatArray<dim> &at) const -> std::optional<std::pair<NNNode<dim>, float>>
        {
            std::optional<std::pair<NNNode<dim>, float>> best;
            auto least = std::numeric_limits<float>::max();
            const FloatVector<dim> from(at.v);
            for (const auto &node : nodes)
            {
                const auto distance = (node.as_vector() - from).l2_norm();
                if (distance < least)
                {
                    least = distance;
                    best = {node, distance};
                }
            }
            return best;
        }
    };
}  // namespace vamp::planning
