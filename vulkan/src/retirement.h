// SPDX-License-Identifier: Apache-2.0
// Keeps what is no longer needed for as long as a frame in flight may use it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon::vulkan {

class Retirement {
public:
    Retirement() { slots_.reserve(kUsualSlots); }

    /// The work that a frame records with its slot, in this order.
    enum class Work : std::uint8_t { bounds, maps, mask };

    /// To be called before anything is recorded with a slot. Work that does not come after the slot's last one begins a
    /// new frame: the slot's last frame has finished then, and resources that waited only for that are freed.
    void enter(std::uint32_t slot, Work work)
    {
        if (slot >= slots_.size()) {
            slots_.resize(slot + 1);
        }
        Slot& one = slots_[slot];
        const bool same_frame = one.pending && work > one.last;
        one = {true, work};
        if (!same_frame) {
            release(slot);
        }
    }
    /// Frees the resource once every slot that has recorded anything so far has begun a new frame; at once when none
    /// has. The moved-from resource is left empty. When memory for the note of it runs out (std::bad_alloc), it stays
    /// where it is: a frame in flight may use it.
    template <class Resource>
    void keep(Resource&& resource)
    {
        static_assert(!std::is_reference_v<Resource> && std::is_nothrow_move_constructible_v<Resource>);
        if (std::ranges::none_of(slots_, &Slot::pending)) {
            [[maybe_unused]] const Resource freed = std::forward<Resource>(resource);
            return;
        }
        std::vector<bool> waits_for;
        for (const Slot& slot : slots_) {
            waits_for.push_back(slot.pending);
        }
        if (waiting_.size() == waiting_.capacity()) {
            waiting_.reserve(2 * waiting_.size() + kUsualSlots);
        }
        waiting_.push_back({std::move(waits_for), std::make_unique<Holds<Resource>>(std::forward<Resource>(resource))});
    }

private:
    static constexpr std::size_t kUsualSlots = 16; // with more, some recordings allocate

    struct Slot {
        bool pending = false; // something was recorded with it
        Work last = Work::bounds;
    };
    struct Held {
        Held() = default;
        Held(const Held&) = delete;
        Held& operator=(const Held&) = delete;
        virtual ~Held() = default;
    };
    template <class Resource>
    struct Holds final : Held {
        explicit Holds(Resource&& r) : resource(std::move(r)) {}
        Resource resource;
    };
    struct Waiting {
        std::vector<bool> slots;
        std::unique_ptr<Held> held;
    };

    void release(std::uint32_t slot)
    {
        for (Waiting& one : waiting_) { // in their order: views go before their images
            if (slot < one.slots.size()) {
                one.slots[slot] = false;
            }
            if (std::find(one.slots.begin(), one.slots.end(), true) == one.slots.end()) {
                one.held.reset();
            }
        }
        std::erase_if(waiting_, [](const Waiting& one) { return one.held == nullptr; });
    }

    std::vector<Slot> slots_;
    std::vector<Waiting> waiting_;
};

} // namespace gnomon::vulkan
