// GLFW with what it has for Vulkan, and without OpenGL.
#pragma once

#include <vulkan/vulkan.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
