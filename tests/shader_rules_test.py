#!/usr/bin/env python3
"""Rules that all shaders keep.

- None branches on what comes from uniforms alone. A CPU driver makes a copy of such a shader for the values that it
  meets, in each frame anew, and keeps it: a film fills the memory. Other drivers lose time. What a uniform would decide is
  a specialisation constant here.
- None takes the remainder of numbers with a sign. Vulkan leaves undefined what it is of negative ones, and drivers differ:
  a sea that was right on two of them was another on a third. Write `uint(a) % uint(b)`, or use a quotient.

    shader_rules_test.py FOLDER_OF_SPIRV
"""
import pathlib
import re
import subprocess
import sys

# Not part of frames.
EXEMPT = ("metatexture_probe", "metatexture_bench", "plain_reads")


def instructions(text):
    for line in text.splitlines():
        if match := re.match(r"\s*(?:(%\w+) = )?(Op\w+)\s*(.*)", line):
            yield match[1], match[2], match[3].split()


class Shader:
    def __init__(self, text):
        self.definitions, self.conditions, self.known, self.remainders = {}, [], {}, []
        for result, op, operands in instructions(text):
            if result:
                self.definitions[result] = (op, operands)
            if op in ("OpSMod", "OpSRem") or (op == "OpSpecConstantOp" and operands[1] in ("SMod", "SRem")):
                self.remainders.append(result)
            if op in ("OpBranchConditional", "OpSwitch"):
                self.conditions.append(operands[0])

    def isUniform(self, variable):
        op, operands = self.definitions.get(variable, ("", []))
        return op == "OpVariable" and operands[1] in ("Uniform", "PushConstant")

    # 0: constant, also by specialisation; 1: depends on uniforms, on constants and on loops' counters alone;
    # 2: on something else.
    def rank(self, value, seen=()):
        if value in self.known:
            return self.known[value]
        if value in seen:
            return 0  # a counter that counts itself on
        op, operands = self.definitions.get(value, ("", []))
        sources = [operand for operand in operands[1:] if operand.startswith("%")]
        if op.startswith(("OpConstant", "OpSpecConstant")):
            rank = 0
        elif op == "OpLoad":
            chain, path = self.definitions.get(sources[0], ("", []))
            isPlain = chain == "OpAccessChain" and self.isUniform(path[1])
            rank = 1 if isPlain and all(self.rank(index) == 0 for index in path[2:]) else 2
        elif op == "OpPhi":
            # A loop's counter: constants, and itself counted on. Others are values that branches chose.
            parts = [self.rank(source, seen + (value,)) for source in sources[::2]]
            isCounter = any(self.reaches(source, value) for source in sources[::2])
            rank = max(parts) if isCounter else 2
        elif op.startswith(("OpImage", "OpFunction", "OpVariable", "OpExtInst", "OpGroup", "OpAtomic")) or not op:
            rank = 2
        else:
            rank = max((self.rank(source, seen) for source in sources), default=0)
        if not seen:
            self.known[value] = rank
        return rank

    def reaches(self, value, wanted, depth=0):
        if value == wanted:
            return True
        op, operands = self.definitions.get(value, ("", []))
        return depth < 4 and op in ("OpIAdd", "OpISub") and any(
            self.reaches(operand, wanted, depth + 1) for operand in operands[1:] if operand.startswith("%"))

    def uniformBranches(self):
        return [condition for condition in self.conditions if self.rank(condition) == 1]


def selfTest():
    shader = Shader("""
      %block = OpVariable %pointer Uniform
      %input = OpVariable %pointer Input
      %zero = OpConstant %int 0
      %fixed = OpSpecConstant %int 1
      %chain = OpAccessChain %pointer %block %zero
      %uniform = OpLoad %int %chain
      %pixel = OpLoad %int %input
      %byUniform = OpIEqual %bool %uniform %zero
      %byPixel = OpIEqual %bool %uniform %pixel
      %byConstant = OpIEqual %bool %fixed %zero
      %i = OpPhi %int %zero %before %next %body
      %next = OpIAdd %int %i %fixed
      %loop = OpSLessThan %bool %i %uniform
      %fixedLoop = OpSLessThan %bool %i %fixed
      %chosen = OpPhi %int %zero %before %fixed %body
      %byChosen = OpIEqual %bool %chosen %uniform
      %signed = OpSMod %int %pixel %uniform
      %unsigned = OpUMod %uint %pixel %uniform
      %early = OpSpecConstantOp %int SMod %fixed %zero
                  OpBranchConditional %byUniform %a %b
                  OpBranchConditional %byPixel %a %b
                  OpBranchConditional %byConstant %a %b
                  OpBranchConditional %loop %a %b
                  OpBranchConditional %fixedLoop %a %b
                  OpBranchConditional %byChosen %a %b
    """)
    assert shader.uniformBranches() == ["%byUniform", "%loop"], shader.uniformBranches()
    assert shader.remainders == ["%signed", "%early"], shader.remainders


def main():
    selfTest()
    files = sorted(pathlib.Path(sys.argv[1]).glob("*.spv"))
    assert len(files) > 20, f"only {len(files)} shaders in {sys.argv[1]}"
    bad = 0
    for file in files:
        if file.stem.startswith(EXEMPT):
            continue
        text = subprocess.run(["spirv-dis", "--no-color", file], check=True, capture_output=True, text=True).stdout
        shader = Shader(text)
        for condition in shader.uniformBranches():
            bad += 1
            print(f"{file.stem}: a branch or loop by uniforms alone: {condition} = "
                  f"{' '.join(map(str, shader.definitions[condition]))}")
        for remainder in shader.remainders:
            bad += 1
            print(f"{file.stem}: the remainder of numbers with a sign: {remainder}")
    print(f"{len(files)} shaders, {bad} faults")
    return bad > 0


sys.exit(main())
