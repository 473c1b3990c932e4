#pragma once
/// The GL entry points lockstep uses, as functions of namespace lockstep::gl: `gl::DrawArrays(...)`.
///
/// They are pointers, resolved at run time from whichever library made the current context, so nothing links against
/// GL. A function GL 3.3 core has is never null while a context is current; a later one is null where the context
/// offers neither its version nor its extension: `if (gl::ClipControl != nullptr)`.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <functional>
#include <string_view>

/// Functions of GL 3.3 core.
#define LOCKSTEP_GL_CORE(X)                                                                                            \
    X(ActiveTexture)                                                                                                   \
    X(AttachShader)                                                                                                    \
    X(BeginQuery)                                                                                                      \
    X(BeginTransformFeedback)                                                                                          \
    X(BindAttribLocation)                                                                                              \
    X(BindBuffer)                                                                                                      \
    X(BindBufferBase)                                                                                                  \
    X(BindBufferRange)                                                                                                 \
    X(BindFragDataLocation)                                                                                            \
    X(BindFramebuffer)                                                                                                 \
    X(BindTexture)                                                                                                     \
    X(BindVertexArray)                                                                                                 \
    X(BindSampler)                                                                                                     \
    X(BlendFunc)                                                                                                       \
    X(BlitFramebuffer)                                                                                                 \
    X(BufferData)                                                                                                      \
    X(BufferSubData)                                                                                                   \
    X(CheckFramebufferStatus)                                                                                          \
    X(Clear)                                                                                                           \
    X(ClearBufferfi)                                                                                                   \
    X(ClearBufferfv)                                                                                                   \
    X(ClearBufferiv)                                                                                                   \
    X(ClearBufferuiv)                                                                                                  \
    X(ClearColor)                                                                                                      \
    X(ClearDepth)                                                                                                      \
    X(ClientWaitSync)                                                                                                  \
    X(ColorMask)                                                                                                       \
    X(CompileShader)                                                                                                   \
    X(CopyBufferSubData)                                                                                               \
    X(CreateProgram)                                                                                                   \
    X(CreateShader)                                                                                                    \
    X(CullFace)                                                                                                        \
    X(DeleteBuffers)                                                                                                   \
    X(DeleteFramebuffers)                                                                                              \
    X(DeleteProgram)                                                                                                   \
    X(DeleteQueries)                                                                                                   \
    X(DeleteSamplers)                                                                                                  \
    X(DeleteShader)                                                                                                    \
    X(DeleteSync)                                                                                                      \
    X(DeleteTextures)                                                                                                  \
    X(DeleteVertexArrays)                                                                                              \
    X(DepthFunc)                                                                                                       \
    X(DepthMask)                                                                                                       \
    X(DepthRange)                                                                                                      \
    X(DetachShader)                                                                                                    \
    X(Disable)                                                                                                         \
    X(DisableVertexAttribArray)                                                                                        \
    X(DrawArrays)                                                                                                      \
    X(DrawArraysInstanced)                                                                                             \
    X(DrawBuffer)                                                                                                      \
    X(DrawBuffers)                                                                                                     \
    X(DrawElements)                                                                                                    \
    X(Enable)                                                                                                          \
    X(EnableVertexAttribArray)                                                                                         \
    X(EndQuery)                                                                                                        \
    X(EndTransformFeedback)                                                                                            \
    X(FenceSync)                                                                                                       \
    X(Finish)                                                                                                          \
    X(Flush)                                                                                                           \
    X(FlushMappedBufferRange)                                                                                          \
    X(FramebufferTexture)                                                                                              \
    X(FramebufferTexture2D)                                                                                            \
    X(FramebufferTextureLayer)                                                                                         \
    X(FrontFace)                                                                                                       \
    X(GenBuffers)                                                                                                      \
    X(GenFramebuffers)                                                                                                 \
    X(GenQueries)                                                                                                      \
    X(GenSamplers)                                                                                                     \
    X(GenTextures)                                                                                                     \
    X(GenVertexArrays)                                                                                                 \
    X(GetActiveAttrib)                                                                                                 \
    X(GetActiveUniform)                                                                                                \
    X(GetActiveUniformBlockName)                                                                                       \
    X(GetActiveUniformBlockiv)                                                                                         \
    X(GetActiveUniformsiv)                                                                                             \
    X(GetAttribLocation)                                                                                               \
    X(GetBooleanv)                                                                                                     \
    X(GetBufferParameteriv)                                                                                            \
    X(GetBufferSubData)                                                                                                \
    X(GetError)                                                                                                        \
    X(GetFloatv)                                                                                                       \
    X(GetFragDataLocation)                                                                                             \
    X(GetFramebufferAttachmentParameteriv)                                                                             \
    X(GetInteger64v)                                                                                                   \
    X(GetIntegeri_v)                                                                                                   \
    X(GetIntegerv)                                                                                                     \
    X(GetProgramInfoLog)                                                                                               \
    X(GetProgramiv)                                                                                                    \
    X(GetQueryiv)                                                                                                      \
    X(GetQueryObjectui64v)                                                                                             \
    X(GetQueryObjectuiv)                                                                                               \
    X(GetShaderInfoLog)                                                                                                \
    X(GetShaderiv)                                                                                                     \
    X(GetString)                                                                                                       \
    X(GetStringi)                                                                                                      \
    X(GetTexImage)                                                                                                     \
    X(GetTexLevelParameteriv)                                                                                          \
    X(GetTransformFeedbackVarying)                                                                                     \
    X(GetUniformLocation)                                                                                              \
    X(GetUniformfv)                                                                                                    \
    X(GetUniformiv)                                                                                                    \
    X(IsEnabled)                                                                                                       \
    X(LinkProgram)                                                                                                     \
    X(MapBufferRange)                                                                                                  \
    X(PixelStorei)                                                                                                     \
    X(PointSize)                                                                                                       \
    X(PolygonOffset)                                                                                                   \
    X(QueryCounter)                                                                                                    \
    X(ReadBuffer)                                                                                                      \
    X(ReadPixels)                                                                                                      \
    X(SamplerParameteri)                                                                                               \
    X(Scissor)                                                                                                         \
    X(ShaderSource)                                                                                                    \
    X(TexBuffer)                                                                                                       \
    X(TexImage2D)                                                                                                      \
    X(TexImage3D)                                                                                                      \
    X(TexParameteri)                                                                                                   \
    X(TexSubImage2D)                                                                                                   \
    X(TexSubImage3D)                                                                                                   \
    X(TransformFeedbackVaryings)                                                                                       \
    X(Uniform1fv)                                                                                                      \
    X(Uniform1i)                                                                                                       \
    X(Uniform1iv)                                                                                                      \
    X(Uniform1uiv)                                                                                                     \
    X(Uniform2fv)                                                                                                      \
    X(Uniform2iv)                                                                                                      \
    X(Uniform2uiv)                                                                                                     \
    X(Uniform3fv)                                                                                                      \
    X(Uniform3iv)                                                                                                      \
    X(Uniform3uiv)                                                                                                     \
    X(Uniform4fv)                                                                                                      \
    X(Uniform4iv)                                                                                                      \
    X(Uniform4uiv)                                                                                                     \
    X(UniformBlockBinding)                                                                                             \
    X(UniformMatrix2fv)                                                                                                \
    X(UniformMatrix3fv)                                                                                                \
    X(UniformMatrix4fv)                                                                                                \
    X(UnmapBuffer)                                                                                                     \
    X(UseProgram)                                                                                                      \
    X(VertexAttribDivisor)                                                                                             \
    X(VertexAttribIPointer)                                                                                            \
    X(VertexAttribPointer)                                                                                             \
    X(Viewport)                                                                                                        \
    X(WaitSync)

/// Later functions: name, the GL version that brought it, the extension that offers it earlier.
#define LOCKSTEP_GL_OPTIONAL(X)                                                                                        \
    X(BindTransformFeedback, 4, 0, "GL_ARB_transform_feedback2")                                                       \
    X(DeleteTransformFeedbacks, 4, 0, "GL_ARB_transform_feedback2")                                                    \
    X(DrawTransformFeedback, 4, 0, "GL_ARB_transform_feedback2")                                                       \
    X(GenTransformFeedbacks, 4, 0, "GL_ARB_transform_feedback2")                                                       \
    X(BindImageTexture, 4, 2, "GL_ARB_shader_image_load_store")                                                        \
    X(MemoryBarrier, 4, 2, "GL_ARB_shader_image_load_store")                                                           \
    X(ShaderBinary, 4, 1, "GL_ARB_ES2_compatibility")                                                                  \
    X(TexStorage2D, 4, 2, "GL_ARB_texture_storage")                                                                    \
    X(DrawElementsIndirect, 4, 0, "GL_ARB_draw_indirect")                                                              \
    X(DispatchCompute, 4, 3, "GL_ARB_compute_shader")                                                                  \
    X(DispatchComputeIndirect, 4, 3, "GL_ARB_compute_shader")                                                          \
    X(ClearBufferData, 4, 3, "GL_ARB_clear_buffer_object")                                                             \
    X(GetProgramInterfaceiv, 4, 3, "GL_ARB_program_interface_query")                                                   \
    X(GetProgramResourceIndex, 4, 3, "GL_ARB_program_interface_query")                                                 \
    X(GetProgramResourceiv, 4, 3, "GL_ARB_program_interface_query")                                                    \
    X(GetProgramResourceName, 4, 3, "GL_ARB_program_interface_query")                                                  \
    X(ShaderStorageBlockBinding, 4, 3, "GL_ARB_shader_storage_buffer_object")                                          \
    X(DebugMessageCallback, 4, 3, "GL_KHR_debug")                                                                      \
    X(ObjectLabel, 4, 3, "GL_KHR_debug")                                                                               \
    X(PushDebugGroup, 4, 3, "GL_KHR_debug")                                                                            \
    X(PopDebugGroup, 4, 3, "GL_KHR_debug")                                                                             \
    X(BufferStorage, 4, 4, "GL_ARB_buffer_storage")                                                                    \
    X(ClearTexImage, 4, 4, "GL_ARB_clear_texture")                                                                     \
    X(ClipControl, 4, 5, "GL_ARB_clip_control")                                                                        \
    X(TextureBarrier, 4, 5, "GL_ARB_texture_barrier")                                                                  \
    X(SpecializeShader, 4, 6, "GL_ARB_gl_spirv")

namespace lockstep::gl {

#define LOCKSTEP_GL_DECLARE(name, ...) extern decltype(&::gl##name) name;
LOCKSTEP_GL_CORE(LOCKSTEP_GL_DECLARE)
LOCKSTEP_GL_OPTIONAL(LOCKSTEP_GL_DECLARE)
#undef LOCKSTEP_GL_DECLARE

/// Address of a GL function by its full name ("glDrawArrays"), or null.
using Resolver = std::function<void*(const char* name)>;

/// Fills the table for the current context. Throws Error naming the first GL 3.3 function that is missing.
void load(const Resolver& resolve);

/// Sets every function to null: no context is current.
void unload();

/// Whether the current context is at least of this version, or offers the extension, if one is named.
bool offers(int major, int minor, const char* extension = "");

/// Whether it offers this extension, whatever its version.
bool has_extension(std::string_view extension);

} // namespace lockstep::gl
