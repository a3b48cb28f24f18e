// SPDX-License-Identifier: Apache-2.0
#include "programs.h"

#include <gnomon_glsl_texts.h>

#include <gnomon/error.h>

#include <algorithm>
#include <charconv>
#include <string>

namespace gnomon::gl {
namespace {

const glsl::Text* find(std::string_view name)
{
    const auto found = std::ranges::find(glsl::kTexts, name, &glsl::Text::name);
    return found != std::end(glsl::kTexts) ? &*found : nullptr;
}

/// As GLSL writes it, of the type that the default's text has.
std::string valueLike(std::string_view text, std::uint32_t word)
{
    if (text == "true" || text == "false") {
        return word != 0 ? "true" : "false";
    }
    if (text.ends_with('u')) {
        return std::to_string(word) + "u";
    }
    if (text.find('.') != text.npos) {
        return "uintBitsToFloat(" + std::to_string(word) + "u)"; // exact
    }
    return std::to_string(static_cast<std::int32_t>(word));
}

/// The text with these values in place of its constants' defaults.
std::string withConstants(std::string_view text, std::span<const std::uint32_t> words)
{
    constexpr std::string_view kDefine = "#define SPIRV_CROSS_CONSTANT_ID_";
    std::string out;
    for (std::size_t at = 0;;) {
        const std::size_t define = text.find(kDefine, at);
        out += text.substr(at, define == text.npos ? define : define - at);
        if (define == text.npos) {
            return out;
        }
        const std::size_t number = define + kDefine.size();
        const std::size_t value = text.find(' ', number) + 1;
        const std::size_t end = text.find('\n', value);
        std::size_t id = 0;
        std::from_chars(text.data() + number, text.data() + value, id);
        const std::string_view old = text.substr(value, end - value);
        out += text.substr(define, value - define);
        out += id < words.size() ? valueLike(old, words[id]) : std::string(old);
        at = end;
    }
}

[[noreturn]] void refuseProgram(std::string_view name, std::string_view log)
{
    std::string line(log.substr(0, log.find('\n')));
    throw Error("compile the shader " + std::string(name), "the driver says: " + line, "take another driver");
}

class Shader {
public:
    Shader(const Context& context, GLenum stage, const glsl::Text& text, std::span<const std::uint32_t> words)
        : gl_(context.gl), name_(gl_.CreateShader(stage))
    {
        const std::string source = withConstants(text.text, words);
        const char* const begin = source.c_str();
        gl_.ShaderSource(name_, 1, &begin, nullptr);
        gl_.CompileShader(name_);
        GLint good = 0;
        gl_.GetShaderiv(name_, GL_COMPILE_STATUS, &good);
        if (good == 0) {
            char log[1024] = {};
            gl_.GetShaderInfoLog(name_, sizeof log, nullptr, log);
            gl_.DeleteShader(name_);
            refuseProgram(text.name, log);
        }
    }
    ~Shader() { gl_.DeleteShader(name_); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    [[nodiscard]] GLuint name() const { return name_; }

private:
    const Functions& gl_;
    GLuint name_;
};

const glsl::Text& textOf(std::string_view name)
{
    const glsl::Text* const text = find(name);
    if (text == nullptr) {
        throw Error("compile the shader " + std::string(name), "the library has none of this name");
    }
    return *text;
}

} // namespace

GLuint Programs::draw(std::string_view vertex, std::string_view fragment, std::span<const std::uint32_t> words)
{
    return get(vertex, fragment, words);
}

GLuint Programs::compute(std::string_view module, std::span<const std::uint32_t> words)
{
    return get(module, {}, words);
}

void Programs::push(std::span<const std::uint32_t> words) const
{
    upload(context_, push_, words);
    context_.gl.BindBufferBase(GL_UNIFORM_BUFFER, kPushBinding, push_.name());
}

GLuint Programs::get(std::string_view first, std::string_view second, std::span<const std::uint32_t> words)
{
    for (const Made& made : made_) {
        if (made.first == first && made.second == second && std::ranges::equal(made.words, words)) {
            return made.program.name();
        }
    }
    const Functions& gl = context_.gl;
    Made made;
    made.program = Program(context_, gl.CreateProgram());
    const GLuint name = made.program.name();
    const glsl::Text& text = textOf(first);
    made.first = text.name;
    {
        const Shader shader(context_, second.empty() ? GL_COMPUTE_SHADER : GL_VERTEX_SHADER, text, words);
        gl.AttachShader(name, shader.name());
    }
    if (!second.empty()) {
        const glsl::Text& more = textOf(second);
        made.second = more.name;
        const Shader shader(context_, GL_FRAGMENT_SHADER, more, words);
        gl.AttachShader(name, shader.name());
    }
    gl.LinkProgram(name);
    GLint good = 0;
    gl.GetProgramiv(name, GL_LINK_STATUS, &good);
    if (good == 0) {
        char log[1024] = {};
        gl.GetProgramInfoLog(name, sizeof log, nullptr, log);
        refuseProgram(second.empty() ? first : second, log);
    }
    made.words.assign(words.begin(), words.end());
    return made_.emplace_back(std::move(made)).program.name();
}

} // namespace gnomon::gl
