"""Kernels as other kernels call them: code that is linked into the caller's, and no machine code of its own.

Numba gives every function that it compiles two wrappers by which Python calls it, optimises it with all
that it calls, and makes machine code of that: for each of some hundred small kernels, and of the innermost
as often as there are callers above it. What only kernels call needs none of it. The kernel that Python
calls is optimised whole, once, with everything that it calls.
"""

from collections.abc import Callable
from typing import Any, cast

import llvmlite.binding as llvm
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder, _LowerResult, compile_result
from numba.core.compiler_machinery import register_pass
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import NativeLowering

_KIND = "called"  # of a library on the disk, beside Numba's own "object"


class CalledLibrary(JITCodeLibrary):
    """Code of a kernel and of what it calls, to be linked into a caller's."""

    def finalize(self) -> None:
        """Link what it calls; optimise and translate nothing."""
        library = cast(Any, self)
        library._raise_if_finalized()
        for called in dict.fromkeys(library._linking_libraries):
            library._reload_init.update(called._reload_init)
            library._final_module.link_in(called._get_module_for_linking(), preserve=True)
        library._finalize_dynamic_globals()
        library._finalized = True

    def serialize_using_object_code(self) -> Any:
        """As the disk has it; Numba's name for what a cache asks for."""
        return self.name, _KIND, cast(Any, self)._get_module_for_linking().as_bitcode()

    @classmethod
    def from_disk(cls, codegen: Any, stored: Any) -> "CalledLibrary":
        """What `serialize_using_object_code` gave."""
        name, kind, bitcode = stored
        if kind != _KIND:
            raise ValueError(f"expected a library of the kind {_KIND!r}, got {kind!r}")
        made = cls(codegen, name)
        made._final_module = llvm.parse_bitcode(bitcode)
        made._finalized = True
        return made


@register_pass(mutates_CFG=True, analysis_only=False)
class _CalledLowering(NativeLowering):
    """Numba's translation of a typed function into LLVM's code, into a `CalledLibrary`."""

    _name = "ftc_jsb_called_lowering"

    def run_pass(self, state: Any) -> bool:
        state.library = cast(Any, CalledLibrary)(
            state.targetctx.codegen(), state.func_id.func_qualname
        )
        state.library.enable_object_caching()
        state.flags.no_compile = True
        cast(Any, super()).run_pass(state)
        lowered, name = state["cr"], _Name()
        state.targetctx.insert_user_function(name, lowered.fndesc, [state.library])
        state["cr"] = _LowerResult(lowered.fndesc, lowered.call_helper, cfunc=name, env=lowered.env)
        return True


class _Name:
    """What stands for the code in Numba's tables, where a function that Python can call stands else."""


# Passes for what kernels do not have: with blocks, closures, literal loops, functions inlined by Numba. Each
# goes through the whole kernel, and has it analysed anew.
_NEEDLESS = frozenset(
    (
        "WithLifting",
        "InlineClosureLikes",
        "RewriteDynamicRaises",
        "MakeFunctionToJitFunction",
        "InlineInlinables",
        "FindLiterallyCalls",
        "LiteralUnroll",
        "LiteralPropagationSubPipelinePass",
        "InlineOverloads",
        "DumpParforDiagnostics",
    )
)


class _CalledCompiler(CompilerBase):
    """Numba's passes, the last but for machine code."""

    def define_pipelines(self) -> list[Any]:
        passes = cast(Any, DefaultPassBuilder).define_nopython_pipeline(self.state)
        passes.passes = [
            (_CalledLowering, meaning) if step is NativeLowering else (step, meaning)
            for step, meaning in passes.passes
            if step.__name__ not in _NEEDLESS
        ]
        passes.finalize()
        return [passes]


class CalledKernel(CPUDispatcher):
    """A kernel that kernels call; Python cannot."""

    def __init__(self, function: Callable[..., Any], options: dict[str, Any]) -> None:
        """Args: the kernel's Python function; Numba's options for the kernel that Python calls."""
        plain = {**options, "no_cpython_wrapper": True, "no_cfunc_wrapper": True}
        cast(Any, super()).__init__(function, targetoptions=plain, pipeline_class=_CalledCompiler)

    def add_overload(self, compiled: Any) -> None:
        """Keep what was compiled; there is nothing that Python could call."""
        cast(Any, self).overloads[tuple(compiled.signature.args)] = compiled


def rebuilt(target_context: Any, reduced: Any) -> Any:
    """What a `CalledKernel` compiled, as Numba's `CompileResult._reduce` left it on the disk."""
    stored, described, environment, signature, objectmode, lifted, annotation, again, _ = reduced
    for function in again or ():
        function()
    return compile_result(
        typing_context=target_context.typing_context,
        target_context=target_context,
        entry_point=_Name(),
        typing_error=None,
        type_annotation=annotation,
        signature=signature,
        objectmode=objectmode,
        lifted=lifted,
        fndesc=described,
        library=CalledLibrary.from_disk(target_context.codegen(), stored),
        call_helper=None,
        environment=environment,
        metadata=None,
        reload_init=again,
        referenced_envs=(),
    )
