from ftc_jsb.api import Campaign as Campaign
from ftc_jsb.api import Command as Command
from ftc_jsb.api import Comparison as Comparison
from ftc_jsb.api import Flight as Flight
from ftc_jsb.api import Identification as Identification
from ftc_jsb.api import LoopSetup as LoopSetup
from ftc_jsb.api import Margins as Margins
from ftc_jsb.api import Measurement as Measurement
from ftc_jsb.api import Moment as Moment
from ftc_jsb.api import Reference as Reference
from ftc_jsb.api import Scenario as Scenario
from ftc_jsb.api import Sweep as Sweep
from ftc_jsb.api import UserError as UserError
from ftc_jsb.api import campaign as campaign
from ftc_jsb.api import compare as compare
from ftc_jsb.api import fly as fly
from ftc_jsb.api import identify as identify
from ftc_jsb.api import load as load
from ftc_jsb.api import margins as margins
from ftc_jsb.api import scenario as scenario
from ftc_jsb.api import sweep as sweep

__version__: str
__all__: list[str]
