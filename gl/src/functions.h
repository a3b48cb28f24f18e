// SPDX-License-Identifier: Apache-2.0
// The functions of OpenGL that this backend calls, by the host's loader.
#pragma once

#include <GL/glcorearb.h>

namespace gnomon::gl {

// DO(the name of its type, its name).
#define GNOMON_GL_FUNCTIONS(DO)                                                                                        \
    DO(ATTACHSHADER, AttachShader)                                                                                     \
    DO(BINDBUFFERBASE, BindBufferBase)                                                                                 \
    DO(BINDBUFFERRANGE, BindBufferRange)                                                                               \
    DO(BINDFRAMEBUFFER, BindFramebuffer)                                                                               \
    DO(BINDIMAGETEXTURE, BindImageTexture)                                                                             \
    DO(BINDSAMPLER, BindSampler)                                                                                       \
    DO(BINDTEXTUREUNIT, BindTextureUnit)                                                                               \
    DO(BINDVERTEXARRAY, BindVertexArray)                                                                               \
    DO(BLENDEQUATIONSEPARATEI, BlendEquationSeparatei)                                                                 \
    DO(BLENDFUNCSEPARATEI, BlendFuncSeparatei)                                                                         \
    DO(CHECKNAMEDFRAMEBUFFERSTATUS, CheckNamedFramebufferStatus)                                                       \
    DO(CLEARNAMEDBUFFERDATA, ClearNamedBufferData)                                                                     \
    DO(CLEARNAMEDFRAMEBUFFERFV, ClearNamedFramebufferfv)                                                               \
    DO(CLEARTEXIMAGE, ClearTexImage)                                                                                   \
    DO(CLIPCONTROL, ClipControl)                                                                                       \
    DO(COLORMASKI, ColorMaski)                                                                                         \
    DO(COMPILESHADER, CompileShader)                                                                                   \
    DO(COPYIMAGESUBDATA, CopyImageSubData)                                                                             \
    DO(COPYNAMEDBUFFERSUBDATA, CopyNamedBufferSubData)                                                                 \
    DO(CREATEBUFFERS, CreateBuffers)                                                                                   \
    DO(CREATEFRAMEBUFFERS, CreateFramebuffers)                                                                         \
    DO(CREATEPROGRAM, CreateProgram)                                                                                   \
    DO(CREATESAMPLERS, CreateSamplers)                                                                                 \
    DO(CREATESHADER, CreateShader)                                                                                     \
    DO(CREATETEXTURES, CreateTextures)                                                                                 \
    DO(CREATEVERTEXARRAYS, CreateVertexArrays)                                                                         \
    DO(DELETEBUFFERS, DeleteBuffers)                                                                                   \
    DO(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                                         \
    DO(DELETEPROGRAM, DeleteProgram)                                                                                   \
    DO(DELETESAMPLERS, DeleteSamplers)                                                                                 \
    DO(DELETESHADER, DeleteShader)                                                                                     \
    DO(DELETETEXTURES, DeleteTextures)                                                                                 \
    DO(DELETEVERTEXARRAYS, DeleteVertexArrays)                                                                         \
    DO(DEPTHFUNC, DepthFunc)                                                                                           \
    DO(DEPTHMASK, DepthMask)                                                                                           \
    DO(DEPTHRANGE, DepthRange)                                                                                         \
    DO(DISABLE, Disable)                                                                                               \
    DO(DISABLEI, Disablei)                                                                                             \
    DO(DISPATCHCOMPUTE, DispatchCompute)                                                                               \
    DO(DRAWARRAYS, DrawArrays)                                                                                         \
    DO(ENABLE, Enable)                                                                                                 \
    DO(ENABLEI, Enablei)                                                                                               \
    DO(GENTEXTURES, GenTextures)                                                                                       \
    DO(GETBOOLEANI_V, GetBooleani_v)                                                                                   \
    DO(GETDOUBLEV, GetDoublev)                                                                                         \
    DO(GETERROR, GetError)                                                                                             \
    DO(GETFLOATI_V, GetFloati_v)                                                                                       \
    DO(GETINTEGERI_V, GetIntegeri_v)                                                                                   \
    DO(GETINTEGERV, GetIntegerv)                                                                                       \
    DO(GETINTERNALFORMATIV, GetInternalformativ)                                                                       \
    DO(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                                           \
    DO(GETPROGRAMIV, GetProgramiv)                                                                                     \
    DO(GETSHADERINFOLOG, GetShaderInfoLog)                                                                             \
    DO(GETSHADERIV, GetShaderiv)                                                                                       \
    DO(GETSTRING, GetString)                                                                                           \
    DO(GETTEXTURELEVELPARAMETERIV, GetTextureLevelParameteriv)                                                         \
    DO(ISENABLED, IsEnabled)                                                                                           \
    DO(ISENABLEDI, IsEnabledi)                                                                                         \
    DO(LINKPROGRAM, LinkProgram)                                                                                       \
    DO(MEMORYBARRIER, MemoryBarrier)                                                                                   \
    DO(NAMEDBUFFERDATA, NamedBufferData)                                                                               \
    DO(NAMEDBUFFERSUBDATA, NamedBufferSubData)                                                                         \
    DO(NAMEDFRAMEBUFFERDRAWBUFFER, NamedFramebufferDrawBuffer)                                                         \
    DO(NAMEDFRAMEBUFFERTEXTURE, NamedFramebufferTexture)                                                               \
    DO(NAMEDFRAMEBUFFERTEXTURELAYER, NamedFramebufferTextureLayer)                                                     \
    DO(POLYGONMODE, PolygonMode)                                                                                       \
    DO(SAMPLERPARAMETERI, SamplerParameteri)                                                                           \
    DO(SCISSORINDEXED, ScissorIndexed)                                                                                 \
    DO(SHADERSOURCE, ShaderSource)                                                                                     \
    DO(TEXTURESTORAGE2D, TextureStorage2D)                                                                             \
    DO(TEXTURESTORAGE2DMULTISAMPLE, TextureStorage2DMultisample)                                                       \
    DO(TEXTURESTORAGE3D, TextureStorage3D)                                                                             \
    DO(TEXTURESTORAGE3DMULTISAMPLE, TextureStorage3DMultisample)                                                       \
    DO(TEXTUREVIEW, TextureView)                                                                                       \
    DO(USEPROGRAM, UseProgram)                                                                                         \
    DO(VIEWPORTINDEXEDF, ViewportIndexedf)

struct Functions {
#define GNOMON_GL_MEMBER(TYPE, NAME) PFNGL##TYPE##PROC NAME = nullptr;
    GNOMON_GL_FUNCTIONS(GNOMON_GL_MEMBER)
#undef GNOMON_GL_MEMBER
};

/// Throws Error where one is missing.
[[nodiscard]] Functions loadFunctions(void* (*get_proc_address)(const char*));

} // namespace gnomon::gl
