"""Packs the folder as it lies here into a wheel. CMake has built what is in it; the wheel is one for this kind of machine."""
from setuptools import Distribution, setup


class Built(Distribution):
    """A package with a part in C."""

    def has_ext_modules(self):
        return True


setup(
    name="gough",
    version="@PROJECT_VERSION@",
    description="@PROJECT_DESCRIPTION@",
    packages=["gough"],
    package_data={"gough": ["*.so", "py.typed", "palette.def", "command/gough"]},
    install_requires=["numpy"],
    python_requires=">=3.11",
    distclass=Built,
    options={"bdist_wheel": {"py_limited_api": "cp311"}},
    zip_safe=False,
)
