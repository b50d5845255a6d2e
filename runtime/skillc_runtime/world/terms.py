"""The terms of the vocabularies that the runtime's own code reads or writes; all others come from skills and scenes."""

SKILLC = "https://w3id.org/skillc/core#"
SKIROS = "http://rvmi.aau.dk/ontologies/skiros.owl#"
WIPING = "https://w3id.org/skillc/wiping#"
RPARTS = "http://www.inf.ufrgs.br/phi-group/ontologies/RParts.owl#"

ARM_DEVICE = RPARTS + "ArmDevice"
TORQUE_CONTROLLED_ARM = SKILLC + "TorqueControlledArm"
POSITION_CONTROLLED_ARM = SKILLC + "PositionControlledArm"
FORCE_TORQUE_SENSOR = SKILLC + "ForceTorqueSensor"
MOBILE_ROBOT = SKILLC + "MobileRobot"
FURNITURE = SKILLC + "Furniture"
SURFACE = SKILLC + "Surface"
TOOL = SKILLC + "Tool"
WORKSTATION = SKILLC + "Workstation"

AT = SKIROS + "at"
CONTAIN = SKIROS + "contain"
HAS_A = SKIROS + "hasA"
HAS_ARM = SKILLC + "hasArm"
HAS_GRIPPER = SKILLC + "hasGripper"
HAS_SENSOR = SKILLC + "hasSensor"
HAS_SHEET = SKILLC + "hasSheet"
HAS_POSTURE = SKILLC + "hasPosture"

FRAME_ID = SKIROS + "FrameId"
BASE_FRAME_ID = SKIROS + "BaseFrameId"
POSITION = tuple(SKIROS + name for name in ("PositionX", "PositionY", "PositionZ"))
ORIENTATION = tuple(SKIROS + name for name in ("OrientationW", "OrientationX", "OrientationY", "OrientationZ"))
SIZE = tuple(SKIROS + name for name in ("SizeX", "SizeY", "SizeZ"))
WEIGHT = SKIROS + "Weight"
GRASP_WIDTH = SKILLC + "graspWidth"

COMPLIANT_CONTROLLER = SKIROS + "CompliantController"
DEVICE_STATE = SKILLC + "deviceState"
POSTURE_NAME = SKILLC + "postureName"
JOINT_VALUES = SKILLC + "jointValues"

LOCATED = SKILLC + "located"
FRICTION = SKILLC + "friction"
FRICTION_LOW = SKILLC + "frictionLow"
FRICTION_HIGH = SKILLC + "frictionHigh"
OFFSET_RANGE = SKILLC + "offsetRange"
TILT_RANGE = SKILLC + "tiltRange"
POSTURE_RANGE = SKILLC + "postureRange"
STIFFNESS_RANGE = SKILLC + "stiffnessRange"
FORCE_NOISE = SKILLC + "forceNoise"
TORQUE_NOISE = SKILLC + "torqueNoise"
JOINT_SPEED_NOISE = SKILLC + "jointSpeedNoise"

COVERAGE = WIPING + "coverage"
IS_CLEAN = WIPING + "isClean"
CLEAN_THRESHOLD = WIPING + "cleanThreshold"

TEMPLATE = SKIROS + "Template"
HAS_TEMPLATE = SKIROS + "hasTemplate"
