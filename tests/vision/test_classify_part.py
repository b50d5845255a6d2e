"""A part is classified by pixels: its label is read, its defects are seen, and what is not seen is not guessed."""

import numpy as np
import pytest

pytest.importorskip("cv2")

from part_pictures import COVER, FLANGE, LENS, face_with, look_down, photograph

from skillc_runtime.motion.pose import Array, Pose
from skillc_runtime.vision.classify_part import ClassifiedPart, classify_part, classify_parts
from skillc_runtime.vision.label_pose import NotDecided
from skillc_runtime.vision.part_look import PartLook

pytestmark = pytest.mark.slow
LOOKS = (COVER, FLANGE)


def classify(reflectance: Array, look: PartLook = COVER, light: float = 0.8, **others: Pose) -> ClassifiedPart:
    pose = look_down()
    image = photograph(reflectance, look.size, pose, light)
    return classify_part(image, LENS, LOOKS, others.get("believed", pose))


@pytest.mark.parametrize(
    ("look", "defect"), [(COVER, ""), (FLANGE, ""), (COVER, "scratch"), (FLANGE, "spot"), (COVER, "colour")]
)
def test_codes_are_read_and_defects_are_seen(look: PartLook, defect: str) -> None:
    code = look.codes[0] + 17
    seen = classify(face_with(defect, look, code).reflectance, look)
    assert (seen.code, seen.kind, seen.good) == (code, look.kind, not defect)
    assert seen.confidence > 0.99
    assert seen.seen_share > 0.95
    assert np.linalg.norm(seen.pose.position - look_down().position) < 0.005


def test_a_defect_that_is_tolerated_is_none_and_one_at_the_limit_is_not_decided() -> None:
    marked = face_with("").reflectance.copy()
    marked[20:24, 20:24] *= 0.2  # 1 mm square
    assert classify(marked).good
    marked[20:28, 20:28] *= 0.2  # as much as is tolerated
    with pytest.raises(NotDecided, match=r"mm2 on the face of label 117 look otherwise, which is too near"):
        classify(marked)


def test_what_is_known_to_be_in_the_way_is_no_defect() -> None:
    image = photograph(face_with("").reflectance, COVER.size, look_down())
    image[:, :285] = 20
    hidden = np.zeros(image.shape[:2], dtype=bool)
    hidden[:, :285] = True
    with pytest.raises(NotDecided, match=r"% of the face of label 117 is seen, without a defect; the rest is hidden"):
        classify_part(image, LENS, LOOKS, look_down(), hidden)
    assert not classify_part(image, LENS, LOOKS, look_down()).good
    image[:], hidden[:] = 20, True
    with pytest.raises(NotDecided, match="something that is known to be there hides the label"):
        classify_part(image, LENS, LOOKS, look_down(), hidden)


def test_without_a_label_light_or_view_nothing_is_decided_and_why_is_said() -> None:
    plain = np.full((240, 200, 3), 0.3)
    with pytest.raises(NotDecided, match="no label is seen within 5 cm"):
        classify(plain)
    with pytest.raises(NotDecided, match="too dark"):
        classify(plain, light=0.02)
    with pytest.raises(NotDecided, match=r"too dark: the white of the label 117 has only \d+ of 255"):
        classify(face_with("").reflectance, light=0.015)
    with pytest.raises(NotDecided, match="out of the view"):
        classify(plain, believed=look_down(x=0.5))
    with pytest.raises(NotDecided, match="no kind of parts has the code 400"):
        classify(face_with("", code=400).reflectance)
    with pytest.raises(NotDecided, match="no label is seen within 5 cm"):
        classify(face_with("").reflectance, believed=look_down(x=0.08))
    with pytest.raises(ValueError, match="640 x 480 pixels in 8 bit colour is expected"):
        classify_part(np.zeros((10, 10, 3), dtype=np.uint8), LENS, LOOKS, look_down())


def test_all_parts_of_a_picture_are_classified_wherever_they_lie() -> None:
    left = photograph(face_with("spot").reflectance, COVER.size, look_down(x=-0.08))
    right = photograph(face_with("", FLANGE, 205).reflectance, FLANGE.size, look_down(turn=2.0, x=0.08))
    unknown = photograph(face_with("", code=400).reflectance, COVER.size, look_down())
    picture = np.concatenate([left[:, :240], unknown[:, 240:400], right[:, 400:]], axis=1)
    first, second, third = classify_parts(picture, LENS, LOOKS)
    assert isinstance(first, ClassifiedPart) and (first.code, first.good) == (117, False)
    assert isinstance(second, NotDecided) and "400" in str(second)
    assert isinstance(third, ClassifiedPart) and (third.kind, third.good) == ("flange", True)
