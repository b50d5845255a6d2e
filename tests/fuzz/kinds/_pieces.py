"""The pieces that texts for readers are made of; two spaces part them, ␣ stands for a space and ↵ for a line end."""

from __future__ import annotations


def _read(text: str) -> tuple[str, ...]:
    pieces = (piece for line in text.strip().splitlines() for piece in line.strip().split("  "))
    return tuple(piece.replace("␣", " ").replace("↵", "\n") for piece in pieces if piece)


NOISE = (
    *(" ", "\t", "\n", "\r", "\x0c", "\0", "\u2028", "\ufffd", "# c\n", "#\n", '"""'),
    *_read(r"""
        é  😀  a  A  n0␣  n0  _  0  7  0.  1e9  1e999  -1  a␣b  a:b  a.b  x␣  true  \u0041  %41  &amp;
        .  ,  :  ;  -  --  +  *  /  //  \  \\  &  |  ^^  @  #  ##  "  '  '''  \"  `
        (  )  [  ]  {  }  <  >  <a>  ()  =  ==  ?  !  $  ~
    """),
)
"""Pieces for every reader; a 0 becomes another number with each repetition."""
TURTLE = _read(r"""
    @prefix␣p0:␣<http://p0#>␣.↵  @prefix  @base␣<http://b/>␣.↵  PREFIX␣q0:␣<http://q0#>↵  ex:a0␣  ex:p␣  p0:a␣  q0:b␣
    z0:c␣  ␣a␣  <http://e/a0>␣  <a0>  _:b0␣  ␣;↵  ␣,↵  ␣.↵  [␣  ␣]  (␣  ␣)  "text0"␣  "text"@en␣  "1"^^xsd:integer␣
    '''long'''␣  12␣  1.5␣  1e3␣  5␣mm␣  a:b:c␣  \.  ..a  "\"  ex:a0␣a␣ex:K␣.↵  ex:a0␣ex:p␣ex:b0␣.↵
    ex:a0␣ex:p␣[␣ex:q␣1␣]␣.↵  lab:a0␣a␣skiros:Product␣.↵  lab:a0␣skiros:contain␣lab:b0␣.↵  ex:a0␣owl:sameAs␣ex:b0␣.↵
    ex:K0␣a␣owl:Class␣;␣rdfs:subClassOf␣ex:K␣.↵  ex:r0␣a␣owl:ObjectProperty␣.↵  ex:g0␣{  Prefix  Prefix(  Ontology:␣
    <http://e/s0>␣<http://e/p>␣<http://e/o>␣<http://e/g>␣.↵
""")
XML = _read(r"""
    <!--␣c␣-->  <!--␣c␣-->↵  <!--  -->  <?xml  <?pi␣x?>  ?>  <!DOCTYPE␣a␣[  ]>  <!DOCTYPE  <![CDATA[  ]]>  &e0;
    <!ENTITY␣e0␣'x'>  <!ENTITY␣e0␣"x">  <!ENTITY  <a>  </a>  <a/>  <ex:a0/>  <owl:Class␣rdf:about="#a0"/>
    <rdf:Description␣rdf:about="#a0">  </rdf:Description>  ␣encoding='utf-8'  <owl:Class>  </owl:Class>
    xmlns:e0="http://e0#"␣  a0="1"␣  rdf:ID='a0'␣  xml:base="http://b0/"␣
""")
JSON = _read(r"""
    {"@id":␣"ex:a0"}  ,{"@id":␣"ex:a0",␣"ex:p":␣1}  "@id":  "@context":␣  {"a0":␣  "a0":␣"@id",  "a":␣"b",  "\u0041"
    "\\"  null,  1e9,  "http://e0#",  ␣␣␣
""")
SKILLS = _read(r"""
    skill␣S0␣{↵  }↵  {↵  ␣in␣a0:␣Product↵  ␣pre␣a0␣is␣Product↵  ␣post␣p0:␣a␣contain␣b↵  impl␣i0␣of␣S0␣{↵  do␣seq␣{↵
    S0(a:␣b)↵  wait␣1␣s↵  task␣t0␣{↵  goal␣a␣contain␣b↵  use␣skiros↵  import␣"f0"↵  class␣C0␣<␣Product↵
    relation␣r0(Product,␣Product)↵  prefix␣e0:␣<http://e0#>↵  #␣allow␣x0:␣why↵  #␣allow␣x0  ##␣doc↵  retry␣2␣{␣
    if␣a␣==␣b␣{␣  }␣else␣{␣  not␣  and␣  or␣  1␣+␣  a0.b␣  12␣mm␣  5␣furlong␣  3␣N/mm␣  (a,␣  a0:␣  a0␣=␣  =>␣
    ->␣o0␣  exists␣x0:␣Product␣(  -␣  't'␣  "t"␣  "t  let␣a0␣=␣1↵  wait␣  do␣  in␣  skil␣  skill␣  impl␣  seq␣{␣
    [1,␣2]␣  contain␣  skill␣S0␣{␣noplan␣}↵  task␣t0␣{␣goal␣a␣contain␣b␣}↵
""")
GOALS = _read(r"""
    (and␣  (or␣  (not␣  (skiros:contain␣lab:A␣lab:B0)␣  (exists␣(?x0␣-␣Thing)␣  (=␣a␣b)␣  (?x␣-␣  -␣Thing␣  and␣  or␣
    lab:A0␣contain␣lab:B␣  A0.b␣==␣1␣  exists␣x0:␣Thing␣(  Box-0␣  a-a  implies␣  not␣  ;␣c↵  Box  x:␣  1␣mm␣  a␣==␣b␣
    {"and":␣[  {"not":␣  {"holds":␣["a",␣"b"]}  ]}  Wipe(surface:␣lab:A0)
""")
TOML = _read(r"""
    name␣=␣"a0"↵  [tasks.t0]↵  k0␣=␣1↵  a.b0␣=␣1↵  a␣.␣  "a0"␣.␣  [[a]]↵  {a0␣=␣  a␣=␣[  [tool.run]↵  seed␣=␣0↵
    "a.b0"␣=␣1↵  1979-05-27T07:32:00␣  0x  1_0  inf↵
""")
SPARQL = _read(r"""
    SELECT␣  ?x0␣  WHERE␣{␣  }␣  ?x␣a␣skiros:Product␣.␣  FILTER(?x␣=␣1)␣  PREFIX␣e0:␣<http://e0#>↵  OPTIONAL␣{␣
    UNION␣{␣  SERVICE␣  e0:a␣  "t"␣  "t  "\"  BIND(1␣+␣1␣AS␣?y0)␣  (␣  )␣  ex:a.  [␣]␣  /␣
""")
PLAIN = _read("a0  a0␣  1.  1.1  :1  step␣  Pick.  http://  u:p@  h/  %2F  ?q=1&  lab:a0,␣")
MODEL = _read(r"""
    <link␣name="l0"/>  <joint␣name="j0"␣type="fixed"><parent␣link="l0"/><child␣link="l0"/></joint>  <link>  </link>
    <joint␣name="j0"␣type="revolute"><parent␣link="a"/><child␣link="l0"/></joint>  <!--␣c␣-->  <body>  </body>
    <body␣name="b0"><geom␣size="1"/></body>  <geom␣size="1␣0␣0"/>  <origin␣xyz="0␣0␣0"/>  <model>  </model>
""")
EVENT = _read('{"run":␣"r",␣"sequence":␣1,␣"event":␣{  "type":␣"task_started",  "a0":␣1,  [  ]  {  }  "  1,')
MESSAGES = ("Content-Length: 1\r\n", "\r\n", "A: b\r\n", "{}", "a: ")
