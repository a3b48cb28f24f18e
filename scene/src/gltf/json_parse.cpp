// SPDX-License-Identifier: Apache-2.0
#include "gltf/json_view.h"
#include "scene/json.h"

namespace gnomon::scene::gltf {

namespace {

class OwnerOfScene final : public JsonOwner {
public:
    explicit OwnerOfScene(Context& context) : context_(context) {}
    [[noreturn]] void fail(const std::string& pointer, const std::string& what, const std::string& found,
                           const std::string& todo) const override
    {
        context_.fail(pointer, what, found, todo);
    }
    void charge(std::uint64_t bytes) override { context_.chargeBytes(bytes, ""); }

private:
    Context& context_;
};

} // namespace

JsonTree<nlohmann::json> parseJson(Context& context, std::span<const std::byte> text)
{
    OwnerOfScene owner(context);
    return readJson<nlohmann::json>({reinterpret_cast<const char*>(text.data()), text.size()}, owner);
}

} // namespace gnomon::scene::gltf
