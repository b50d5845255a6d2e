# skillc with its planners, films and the language server: `docker build -t skillc .`, then for example
# `docker run --rm -v "$PWD:/work" skillc run --out out`.
FROM python:3.12-slim

# The libraries with which MuJoCo draws films and stills without a screen.
RUN apt-get update && apt-get install --yes --no-install-recommends libegl1 libgl1-mesa-dri && rm -rf /var/lib/apt/lists/*

WORKDIR /src
COPY pyproject.toml constraints.txt hatch_build.py README.md LICENSE ./
COPY dsl dsl
COPY ontology ontology
COPY compiler compiler
COPY runtime runtime
COPY app app
COPY skills_src skills_src
COPY studio studio
RUN pip install --no-cache-dir --constraint constraints.txt '.[all]'

# The user and the state folder of `skillc serve`; a new volume that is mounted there gets its owner.
RUN useradd --create-home skillc && install --directory --owner skillc --group skillc --mode 700 /var/lib/skillc
EXPOSE 8421

WORKDIR /work
ENTRYPOINT ["skillc"]
